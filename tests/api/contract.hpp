#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tests/support/json_schema.hpp"

namespace raywatch::testing {

/// The OpenAPI file, against which every answer in these tests is held.
class Contract {
 public:
  Contract();

  const nlohmann::json& document() const { return document_; }
  const JsonSchema& schemas() const { return schemas_; }
  /// What "$ref" leads to, if there is one.
  const nlohmann::json& resolved(const nlohmann::json& value) const;

  /// What an answer has that the contract does not say. Empty when all is as it says.
  /// @param pattern as in `paths`; empty when no route matches.
  std::string check(const std::string& method, const std::string& pattern, int status, const std::string& content_type,
                    const std::string& body) const;

 private:
  const nlohmann::json document_;
  const JsonSchema schemas_;
};

/// The one contract of these tests.
const Contract& contract();

}  // namespace raywatch::testing
