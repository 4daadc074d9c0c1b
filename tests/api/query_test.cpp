#include "api/query.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"

namespace raywatch {
namespace {

std::string complaint_about(Query& query, const std::string& field) {
  try {
    query.finish();
  } catch (const InvalidInput& error) {
    for (const FieldError& found : error.fields())
      if (found.field == field) return found.message;
  }
  return "";
}

TEST_CASE("values are decoded once, and '+' is a blank") {
  Query query("a=x%2By+z&b=%25&c=%E2%82%AC");
  CHECK_EQ(query.text("a"), "x+y z");
  CHECK_EQ(query.text("b"), "%");
  CHECK_EQ(query.text("c"), "\xE2\x82\xAC");
  CHECK_NOTHROW(query.finish());
}

TEST_CASE("a parameter that nobody asked for is refused with the nearest that somebody asked for") {
  Query query("captured_ta=1");
  query.text("captured_at");
  query.text("pose");
  CHECK_EQ(complaint_about(query, "captured_ta"), "unknown parameter; did you mean 'captured_at'?");
  Query far("xyzzy=1");
  far.text("from");
  far.text("to");
  CHECK_EQ(complaint_about(far, "xyzzy"), "unknown parameter; known are from, to");
}

TEST_CASE("a parameter that is given twice, is empty, or is no text is refused") {
  for (const char* text : {"a=1&a=2", "a=", "a", "a=%", "a=%4", "a=%g0", "a=%ff", "a=%ED%A0%80"}) {
    CAPTURE(text);
    Query query(text);
    query.text("a");
    CHECK_NE(complaint_about(query, "a"), "");
  }
}

TEST_CASE("numbers are whole values within their bounds") {
  for (const char* text : {"a=1x", "a=", "a=0x10", "a=nan", "a=inf", "a=1e999", "a=-1", "a=11", "a=+-1", "a= 1"}) {
    CAPTURE(text);
    Query query(text);
    CHECK_EQ(query.real("a", {.min = 0.0, .max = 10.0}), std::nullopt);
    CHECK_NE(complaint_about(query, "a"), "");
  }
  Query query("a=2.5&b=-3&c=%2B4");
  CHECK_EQ(query.real("a"), 2.5);
  CHECK_EQ(query.integer("b"), -3);
  CHECK_EQ(query.integer("c"), 4);
  CHECK_NOTHROW(query.finish());
}

TEST_CASE("a time keeps its offset whether its plus was encoded or not") {
  for (const char* text : {"t=2026-03-01T02:10:00%2B01:00", "t=2026-03-01T02:10:00+01:00", "t=2026-03-01T01:10:00Z"}) {
    CAPTURE(text);
    Query query(text);
    CHECK_EQ(query.time("t"), parse_rfc3339("2026-03-01T01:10:00Z"));
  }
}

TEST_CASE("vectors have as many numbers as they should") {
  for (const char* text : {"v=1,2", "v=1,2,3,4", "v=1,,3", "v=1,2,", "v=a,b,c", "v=1,2,nan"}) {
    CAPTURE(text);
    Query query(text);
    CHECK_EQ(query.vector3("v"), std::nullopt);
    CHECK_NE(complaint_about(query, "v"), "");
  }
  Query query("v=1,-2.5,3e2");
  CHECK_EQ(query.vector3("v"), Eigen::Vector3d(1.0, -2.5, 300.0));
}

}  // namespace
}  // namespace raywatch
