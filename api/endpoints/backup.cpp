#include <filesystem>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/json.hpp"
#include "api/json_body.hpp"
#include "api/json_object.hpp"

namespace raywatch::endpoints {
namespace {

std::filesystem::path checked_directory(const std::string& text) {
  const std::filesystem::path directory = text;
  if (!directory.is_absolute()) throw InvalidInput("must be an absolute path on the daemon's machine");
  if (text.find('\0') != std::string::npos) throw InvalidInput("must not have a NUL");
  return directory;
}

std::filesystem::path parse_directory(const nlohmann::json& json) {
  FieldErrors errors;
  JsonObject body(json, "", errors);
  body.require("directory");
  const auto directory = body.parsed("directory", checked_directory);
  body.finish();
  errors.throw_if_any();
  return *directory;
}

}  // namespace

HttpAnswer create_backup(Call& call) {
  call.query.finish();
  const std::filesystem::path directory = parse_directory(json_body(call));
  call.services.commands.backup(directory);
  return json_answer({{"directory", directory.string()}}, 201);
}

}  // namespace raywatch::endpoints
