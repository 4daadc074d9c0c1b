#include "storage/cursor.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "core/error.hpp"

namespace raywatch {
namespace {

TEST_CASE("a cursor leads back to the key that it was made of") {
  CHECK(rc::check("any numbers", [](const std::vector<std::int64_t>& key) {
    RC_ASSERT(decode_cursor(encode_cursor("scans", key), "scans", key.size()) == key);
  }));
}

TEST_CASE("a cursor of another list, of another length or of nobody is refused by name") {
  const std::vector<std::int64_t> key{1, 2};
  const auto field_of = [](const auto& decode) -> std::string {
    try {
      decode();
    } catch (const InvalidInput& error) {
      return error.fields().at(0).field;
    }
    return "";
  };
  CHECK(field_of([&] { decode_cursor(encode_cursor("scans", key), "sites", 2); }) == "cursor");
  CHECK(field_of([&] { decode_cursor(encode_cursor("scans", key), "scans", 3); }) == "cursor");
  for (const char* text : {"", "!", "AAAA", "c2NhbnM", "7", "c2NhbnMgMSAyIDM="}) {
    CAPTURE(text);
    CHECK(field_of([&] { decode_cursor(text, "scans", 2); }) == "cursor");
  }
}

TEST_CASE("any text but a cursor is refused without a crash") {
  CHECK(rc::check("any text", [](const std::string& text) {
    try {
      const std::vector<std::int64_t> key = decode_cursor(text, "scans", 2);
      RC_ASSERT(encode_cursor("scans", key) == text);
    } catch (const InvalidInput&) {
    }
  }));
}

TEST_CASE("a limit outside of 1 to 1000 is refused") {
  for (const std::size_t limit : {std::size_t{0}, std::size_t{1001}}) {
    CHECK_THROWS_AS(checked_limit({.limit = limit, .cursor = std::nullopt}), InvalidInput);
  }
  CHECK(checked_limit({.limit = 1000, .cursor = std::nullopt}) == 1000);
}

}  // namespace
}  // namespace raywatch
