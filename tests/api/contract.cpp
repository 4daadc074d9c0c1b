#include "tests/api/contract.hpp"

#include "api/openapi_text.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

Contract::Contract() : document_(json::parse(openapi_text())), schemas_(document_) {}

const Contract& contract() {
  static const Contract instance;
  return instance;
}

const json& Contract::resolved(const json& value) const {
  if (!value.contains("$ref")) return value;
  return document_.at(json::json_pointer(value["$ref"].get<std::string>().substr(1)));
}

std::string Contract::check(const std::string& method, const std::string& pattern, int status,
                            const std::string& content_type, const std::string& body) const {
  const std::string type = content_type.substr(0, content_type.find(';'));
  const json& problem = document_["components"]["responses"]["Problem"];
  const json* response = &problem;
  if (!pattern.empty()) {
    const json& path = document_["paths"].at(pattern);
    const std::string operation = lower_case(method == "HEAD" ? "GET" : method);
    if (path.contains(operation)) {
      const json& responses = path[operation]["responses"];
      const std::string code = std::to_string(status);
      response = &resolved(responses.contains(code) ? responses[code] : responses["default"]);
    }
  }
  if (!response->contains("content")) return body.empty() ? "" : "the contract says that there is no content";
  if (method == "HEAD") return body.empty() ? "" : "an answer to HEAD has content";
  if (!(*response)["content"].contains(type)) return "the contract has no content of type " + type;
  const json& schema = (*response)["content"][type]["schema"];
  if (type != "application/json" && type != "application/problem+json") return "";
  const json value = json::parse(body, nullptr, false);
  if (value.is_discarded()) return "the content is no JSON";
  std::string complaints;
  for (const std::string& complaint : schemas_.check(value, schema)) complaints += complaint + "\n";
  return complaints;
}

}  // namespace raywatch::testing
