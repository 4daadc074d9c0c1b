#include "api/json_object.hpp"

#include <doctest/doctest.h>

#include "api/json.hpp"

namespace raywatch {
namespace {

using nlohmann::json;

TEST_CASE("members are what they are, not what they could be converted to") {
  const json value = {{"text", 1}, {"flag", 0}, {"real", "1.5"}, {"integer", 1.0}, {"huge", 18446744073709551615ULL}};
  FieldErrors errors;
  JsonObject object(value, "", errors);
  CHECK_EQ(object.text("text"), std::nullopt);
  CHECK_EQ(object.flag("flag"), std::nullopt);
  CHECK_EQ(object.real("real"), std::nullopt);
  CHECK_EQ(object.integer("integer"), std::nullopt);
  CHECK_EQ(object.integer("huge"), std::nullopt);
  object.finish();
  try {
    errors.throw_if_any();
    FAIL("five members are wrong");
  } catch (const InvalidInput& error) {
    CHECK_EQ(error.fields().size(), 5);
  }
}

TEST_CASE("errors of nested members have the whole way in their names") {
  const json value = {{"pose", {{"position_m", {1, 2}}, {"orientation_xyzw", {0, 0, 0, 1}}, {"extra", 1}}}};
  FieldErrors errors;
  JsonObject object(value, "", errors);
  CHECK_FALSE(object.pose("pose"));
  try {
    errors.throw_if_any();
    FAIL("two members are wrong");
  } catch (const InvalidInput& error) {
    REQUIRE_EQ(error.fields().size(), 2);
    CHECK_EQ(error.fields()[0].field, "pose.position_m");
    CHECK_EQ(error.fields()[1].field, "pose.extra");
  }
}

TEST_CASE("repeated members, broken text and deep nesting are refused at any depth") {
  for (const std::string text :
       {R"({"a": {"b": 1, "b": 2}})", R"([{"a": 1, "a": 1}])", "[\"\xff\"]", "[1,]", "nul", ""}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_json(text), InvalidInput);
  }
  CHECK_THROWS_AS(parse_json(std::string(40, '[') + std::string(40, ']')), InvalidInput);
  CHECK_NOTHROW(parse_json(R"({"a": {"b": 1}, "c": {"b": 2}, "b": [{"b": 3}, {"b": 4}]})"));
}

TEST_CASE("bytes that are no UTF-8 are replaced on the way out") {
  CHECK_EQ(to_json_text(Json{{"a", "x\xffy"}}), "{\"a\":\"x\xEF\xBF\xBDy\"}");
}

}  // namespace
}  // namespace raywatch
