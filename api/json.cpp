#include "api/json.hpp"

#include <set>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace raywatch {
namespace {

constexpr int kMaxDepth = 32;

/// Refuses what nlohmann's parser lets pass: repeated members, of which it keeps the last, and any depth.
class StructureCheck {
 public:
  bool operator()(int depth, nlohmann::json::parse_event_t event, const nlohmann::json& value) {
    using Event = nlohmann::json::parse_event_t;
    if (depth > kMaxDepth) throw InvalidInput("The JSON is nested more than 32 levels deep.");
    if (event == Event::object_start) members_.emplace_back();
    if (event == Event::object_end) members_.pop_back();
    if (event == Event::key && !members_.back().insert(value.get<std::string>()).second) {
      const std::string name = value.get<std::string>();
      throw InvalidInput("The JSON has the member '" + name + "' twice.", {{name, "is given more than once"}});
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> members_;
};

/// The parser's message without its own prefix: "[json.exception.parse_error.101] parse error at line ...".
std::string without_prefix(std::string_view message) {
  const std::size_t end = message.find("] ");
  return std::string(end == std::string_view::npos ? message : message.substr(end + 2));
}

}  // namespace

std::string to_json_text(const Json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

HttpAnswer json_text_answer(JsonText json) {
  HttpAnswer answer;
  answer.content_type = "application/json";
  answer.body = std::move(json.text);
  return answer;
}

HttpAnswer json_answer(const Json& json, int status) {
  HttpAnswer answer = json_text_answer({to_json_text(json)});
  answer.status = status;
  return answer;
}

nlohmann::json parse_json(std::string_view text) {
  StructureCheck check;
  try {
    return nlohmann::json::parse(
        text, [&check](int depth, auto event, const nlohmann::json& value) { return check(depth, event, value); });
  } catch (const nlohmann::json::parse_error& error) {
    const std::string message = "malformed JSON at byte " + std::to_string(error.byte) + ": ";
    throw InvalidInput(message + without_prefix(error.what()), {{"", message + without_prefix(error.what())}});
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput("malformed JSON: " + without_prefix(error.what()), {{"", without_prefix(error.what())}});
  }
}

}  // namespace raywatch
