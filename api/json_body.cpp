#include "api/json_body.hpp"

#include "api/json.hpp"
#include "api/problem.hpp"
#include "api/text_values.hpp"

namespace raywatch {
namespace {

constexpr std::uint64_t kMaxJsonBytes = 1 << 20;

bool is_json_type(std::string_view content_type) {
  const std::string type = lower(without_blanks(content_type.substr(0, content_type.find(';'))));
  return type.empty() || type == "application/json" || (type.starts_with("application/") && type.ends_with("+json"));
}

}  // namespace

nlohmann::json json_body(Call& call) {
  if (!is_json_type(call.body.content_type())) {
    throw HttpError(unsupported_media_type("The content must be JSON; send Content-Type: application/json."));
  }
  return parse_json(call.body.text(kMaxJsonBytes));
}

}  // namespace raywatch
