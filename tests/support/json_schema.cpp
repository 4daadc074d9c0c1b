#include "tests/support/json_schema.hpp"

#include <algorithm>
#include <regex>
#include <set>

#include "core/error.hpp"
#include "core/time.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

const std::set<std::string> kKeywords = {"type",      "properties",
                                         "required",  "additionalProperties",
                                         "items",     "minItems",
                                         "maxItems",  "enum",
                                         "oneOf",     "anyOf",
                                         "$ref",      "minimum",
                                         "maximum",   "exclusiveMinimum",
                                         "minLength", "maxLength",
                                         "pattern",   "format"};
const std::set<std::string> kAnnotations = {"description", "default", "examples", "example", "contentMediaType"};

bool has_type(const json& value, const std::string& type) {
  if (type == "null") return value.is_null();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "string") return value.is_string();
  if (type == "array") return value.is_array();
  if (type == "object") return value.is_object();
  return false;
}

bool has_one_type(const json& value, const json& types) {
  if (types.is_string()) return has_type(value, types.get<std::string>());
  return std::ranges::any_of(types, [&](const json& type) { return has_type(value, type.get<std::string>()); });
}

void check_number(const json& value, const json& schema, const std::string& place,
                  std::vector<std::string>& complaints) {
  const auto number = value.get<double>();
  if (schema.contains("minimum") && number < schema["minimum"].get<double>())
    complaints.push_back(place + ": too small");
  if (schema.contains("maximum") && number > schema["maximum"].get<double>())
    complaints.push_back(place + ": too large");
  if (schema.contains("exclusiveMinimum") && number <= schema["exclusiveMinimum"].get<double>()) {
    complaints.push_back(place + ": not above its lower bound");
  }
}

void check_text(const json& value, const json& schema, const std::string& place, std::vector<std::string>& complaints) {
  const auto text = value.get<std::string>();
  if (text.size() < schema.value("minLength", std::size_t{0})) complaints.push_back(place + ": too short");
  if (text.size() > schema.value("maxLength", text.size())) complaints.push_back(place + ": too long");
  if (schema.contains("pattern") && !std::regex_search(text, std::regex(schema["pattern"].get<std::string>()))) {
    complaints.push_back(place + ": does not match its pattern");
  }
  if (!schema.contains("format")) return;
  if (schema["format"] != "date-time") complaints.push_back(place + ": unknown format in the schema");
  try {
    parse_rfc3339(text);
    if (!text.ends_with('Z')) complaints.push_back(place + ": is not in UTC");
  } catch (const InvalidInput&) {
    complaints.push_back(place + ": is no date-time");
  }
}

}  // namespace

std::vector<std::string> JsonSchema::check(const json& value, const json& schema) const {
  std::vector<std::string> complaints = unknown_keywords(schema);
  check_at(value, schema, "$", complaints);
  return complaints;
}

std::vector<std::string> JsonSchema::unknown_keywords(const json& schema) const {
  std::vector<std::string> complaints;
  if (schema.is_boolean()) return complaints;
  const auto descend = [&](const json& below) {
    for (std::string& complaint : unknown_keywords(below)) complaints.push_back(std::move(complaint));
  };
  for (const auto& [keyword, content] : schema.items()) {
    if (!kKeywords.contains(keyword) && !kAnnotations.contains(keyword))
      complaints.push_back("unknown keyword " + keyword);
    if (keyword == "properties")
      for (const auto& [name, property] : content.items()) descend(property);
    if (keyword == "items" || keyword == "additionalProperties") descend(content);
    if (keyword == "oneOf" || keyword == "anyOf")
      for (const json& choice : content) descend(choice);
    if (keyword == "$ref" && !document_.contains(json::json_pointer(content.get<std::string>().substr(1)))) {
      complaints.push_back("nothing at " + content.get<std::string>());
    }
  }
  return complaints;
}

void JsonSchema::check_at(const json& value, const json& schema, const std::string& place,
                          std::vector<std::string>& complaints) const {
  if (schema.is_boolean()) {
    if (!schema.get<bool>()) complaints.push_back(place + ": must not be there");
    return;
  }
  if (schema.contains("$ref")) {
    const json::json_pointer target(schema["$ref"].get<std::string>().substr(1));
    const json& referred = document_.at(target);
    for (std::string& complaint : unknown_keywords(referred)) complaints.push_back(place + ": " + complaint);
    check_at(value, referred, place, complaints);
  }
  if (schema.contains("type") && !has_one_type(value, schema["type"])) {
    complaints.push_back(place + ": is " + std::string(value.type_name()) + ", not " + schema["type"].dump());
    return;
  }
  if (schema.contains("enum") && std::ranges::find(schema["enum"], value) == schema["enum"].end()) {
    complaints.push_back(place + ": " + value.dump() + " is none of " + schema["enum"].dump());
  }
  if (value.is_number()) check_number(value, schema, place, complaints);
  if (value.is_string()) check_text(value, schema, place, complaints);
  if (value.is_object()) check_object(value, schema, place, complaints);
  if (value.is_array()) check_array(value, schema, place, complaints);
  check_choice(value, schema, place, complaints);
}

void JsonSchema::check_object(const json& value, const json& schema, const std::string& place,
                              std::vector<std::string>& complaints) const {
  for (const json& name : schema.value("required", json::array())) {
    if (!value.contains(name.get<std::string>())) complaints.push_back(place + ": lacks " + name.get<std::string>());
  }
  static const json no_properties = json::object();
  const json& properties = schema.contains("properties") ? schema["properties"] : no_properties;
  for (const auto& [name, member] : value.items()) {
    if (properties.contains(name)) {
      check_at(member, properties[name], place + "." + name, complaints);
    } else if (schema.contains("additionalProperties")) {
      check_at(member, schema["additionalProperties"], place + "." + name, complaints);
    }
  }
}

void JsonSchema::check_array(const json& value, const json& schema, const std::string& place,
                             std::vector<std::string>& complaints) const {
  if (value.size() < schema.value("minItems", std::size_t{0})) complaints.push_back(place + ": too few items");
  if (value.size() > schema.value("maxItems", value.size())) complaints.push_back(place + ": too many items");
  if (!schema.contains("items")) return;
  for (std::size_t i = 0; i < value.size(); ++i) {
    check_at(value[i], schema["items"], place + "[" + std::to_string(i) + "]", complaints);
  }
}

void JsonSchema::check_choice(const json& value, const json& schema, const std::string& place,
                              std::vector<std::string>& complaints) const {
  for (const char* keyword : {"oneOf", "anyOf"}) {
    if (!schema.contains(keyword)) continue;
    std::size_t fitting = 0;
    std::string reasons;
    for (const json& choice : schema[keyword]) {
      std::vector<std::string> of_choice;
      check_at(value, choice, place, of_choice);
      if (of_choice.empty()) ++fitting;
      for (const std::string& complaint : of_choice) reasons += " | " + complaint;
    }
    const bool fits = std::string(keyword) == "oneOf" ? fitting == 1 : fitting > 0;
    if (!fits) complaints.push_back(place + ": fits " + std::to_string(fitting) + " of " + keyword + reasons);
  }
}

}  // namespace raywatch::testing
