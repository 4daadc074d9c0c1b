#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/openapi_text.hpp"

namespace raywatch::endpoints {

HttpAnswer get_openapi(Call& call) {
  call.query.finish();
  HttpAnswer answer;
  answer.content_type = "application/json";
  answer.body = openapi_text();
  return with_body_tag(std::move(answer), call.header("If-None-Match"));
}

}  // namespace raywatch::endpoints
