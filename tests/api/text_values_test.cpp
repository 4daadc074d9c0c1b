#include "api/text_values.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>

namespace raywatch {
namespace {

/// Code points of every length that UTF-8 has, between which the encoding may not slip.
const std::vector<std::string> kCharacters = {
    "a", "%", "+", " ", "&", "=", "/", "\n", "\xC3\xBC", "\xE2\x82\xAC", "\xF0\x9F\x90\xA0"};

TEST_CASE("any UTF-8 survives being encoded and decoded") {
  CHECK(rc::check([](const std::vector<std::uint8_t>& choices) {
    std::string text;
    for (const std::uint8_t choice : choices) text += kCharacters[choice % kCharacters.size()];
    RC_ASSERT(percent_decoded(percent_encoded(text), false) == text);
    RC_ASSERT(percent_decoded(percent_encoded(text), true) == text);
  }));
}

TEST_CASE("what is not UTF-8 is told") {
  for (const char* text : {"\x80", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                           "\xF8\x88\x80\x80\x80", "\xE2\x82", "a\xC3"}) {
    CHECK_FALSE(is_utf8(text));
  }
  for (const char* text : {"", "a", "\xC3\xBC", "\xE2\x82\xAC", "\xF0\x9F\x90\xA0", "\xF4\x8F\xBF\xBF"})
    CHECK(is_utf8(text));
}

TEST_CASE("a number's text reads back as the same number") {
  CHECK(rc::check([](double value) {
    RC_PRE(std::isfinite(value));
    RC_ASSERT(parse_finite(to_text(value)) == value);
  }));
}

}  // namespace
}  // namespace raywatch
