#include "tests/support/json_schema.hpp"

#include <doctest/doctest.h>

namespace raywatch::testing {
namespace {

using nlohmann::json;

const json kDocument = json::parse(R"({"defs": {"id": {"type": "integer", "minimum": 1}}})");

bool fits(const json& value, const std::string& schema) {
  return JsonSchema(kDocument).check(value, json::parse(schema)).empty();
}

TEST_CASE("the validator accepts what fits and refuses what does not") {
  struct Case {
    const char* schema;
    json good, bad;
  };
  const std::vector<Case> cases = {
      {R"({"type": "integer"})", 1, 1.5},
      {R"({"type": ["number", "null"]})", nullptr, "x"},
      {R"({"type": "object", "required": ["a"]})", {{"a", 1}}, json::object()},
      {R"({"type": "object", "properties": {"a": {"type": "string"}}, "additionalProperties": false})",
       {{"a", "x"}},
       {{"b", "x"}}},
      {R"({"type": "object", "additionalProperties": {"type": "number"}})", {{"b", 1}}, {{"b", "x"}}},
      {R"({"type": "array", "items": {"type": "boolean"}, "minItems": 1, "maxItems": 2})", {true}, json::array()},
      {R"({"items": {"type": "boolean"}})", {true}, {1}},
      {R"({"enum": ["a", null]})", nullptr, "b"},
      {R"({"oneOf": [{"type": "integer"}, {"minimum": 5}]})", 1, 7},
      {R"({"anyOf": [{"type": "string"}, {"type": "null"}]})", "x", 1},
      {R"({"$ref": "#/defs/id"})", 1, 0},
      {R"({"minimum": 0, "maximum": 1})", 1.0, 1.1},
      {R"({"exclusiveMinimum": 0})", 0.1, 0},
      {R"({"minLength": 1, "maxLength": 2})", "ab", ""},
      {R"({"pattern": "^[a-z]+$"})", "abc", "aBc"},
      {R"({"format": "date-time"})", "2026-03-01T08:00:00Z", "yesterday"},
  };
  for (const Case& c : cases) {
    CAPTURE(c.schema);
    CHECK(fits(c.good, c.schema));
    CHECK_FALSE(fits(c.bad, c.schema));
  }
}

TEST_CASE("a keyword or reference that the validator does not know is an error, even where no value reaches it") {
  CHECK_FALSE(fits(1, R"({"multipleOf": 1})"));
  CHECK_FALSE(fits(json::object(), R"({"properties": {"a": {"not": {}}}})"));
  CHECK_FALSE(fits(json::object(), R"({"properties": {"a": {"$ref": "#/defs/nothing"}}})"));
}

}  // namespace
}  // namespace raywatch::testing
