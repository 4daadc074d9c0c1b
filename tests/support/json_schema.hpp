#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace raywatch::testing {

/// A validator for the part of JSON Schema that the contract uses: type, properties, required, additionalProperties,
/// items, minItems, maxItems, enum, oneOf, anyOf, $ref, minimum, maximum, exclusiveMinimum, minLength, maxLength,
/// pattern and format date-time. Annotations are passed over. Any other keyword is an error, so that none goes
/// unchecked.
class JsonSchema {
 public:
  /// `document` is what "#/..." refers to; it must outlive this.
  explicit JsonSchema(const nlohmann::json& document) : document_(document) {}

  /// What is wrong with `value`; empty when nothing is.
  std::vector<std::string> check(const nlohmann::json& value, const nlohmann::json& schema) const;

  /// Keywords in `schema` and below that this validator does not know, and references that lead nowhere.
  std::vector<std::string> unknown_keywords(const nlohmann::json& schema) const;

 private:
  void check_at(const nlohmann::json& value, const nlohmann::json& schema, const std::string& place,
                std::vector<std::string>& complaints) const;
  void check_object(const nlohmann::json& value, const nlohmann::json& schema, const std::string& place,
                    std::vector<std::string>& complaints) const;
  void check_array(const nlohmann::json& value, const nlohmann::json& schema, const std::string& place,
                   std::vector<std::string>& complaints) const;
  void check_choice(const nlohmann::json& value, const nlohmann::json& schema, const std::string& place,
                    std::vector<std::string>& complaints) const;

  const nlohmann::json& document_;
};

}  // namespace raywatch::testing
