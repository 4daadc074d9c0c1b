#include "config/config_reader.hpp"

#include <doctest/doctest.h>

#include <array>

namespace raywatch {
namespace {

struct Lamp {
  double height_m = 2.5;
  unsigned count = 4;
  bool lit = false;
  std::string colour = "white";
  std::chrono::seconds delay{10};
  std::uint64_t memory_bytes = std::uint64_t{3} << 20;
};

constexpr std::array<std::string_view, 2> kColours = {"white", "red"};

void bind(ConfigReader& reader, Lamp& lamp) {
  reader.real("lamp.height_m", lamp.height_m, {.min = 0.5, .max = 12.0});
  reader.whole("lamp.count", lamp.count, {.min = 1, .max = 9});
  reader.flag("lamp.lit", lamp.lit);
  reader.one_of("lamp.colour", lamp.colour, kColours);
  reader.duration("timing.delay_s", lamp.delay, {.min = 0, .max = 60});
  reader.mebibytes("timing.memory_mib", lamp.memory_bytes, {.min = 1});
}

Lamp read_lamp(std::string_view toml) {
  ConfigReader reader(toml, "lamp.toml");
  Lamp lamp;
  bind(reader, lamp);
  reader.finish();
  return lamp;
}

/// The errors of a text that must be refused.
std::vector<FieldError> errors_of(std::string_view toml) {
  try {
    read_lamp(toml);
  } catch (const InvalidInput& error) {
    CHECK(std::string(error.what()).find("lamp.toml") == 0);
    return error.fields();
  }
  FAIL("the text was accepted");
  return {};
}

}  // namespace

TEST_CASE("what the file does not name keeps its default") {
  const Lamp lamp = read_lamp("");
  CHECK(lamp.height_m == 2.5);
  CHECK(lamp.delay == std::chrono::seconds(10));
}

TEST_CASE("values are read into their fields") {
  const Lamp lamp = read_lamp(R"(
    [lamp]
    height_m = 3      # a whole number is a number
    count = 9
    lit = true
    colour = "red"
    [timing]
    delay_s = 60
    memory_mib = 5
  )");
  CHECK(lamp.height_m == 3.0);
  CHECK(lamp.count == 9);
  CHECK(lamp.lit);
  CHECK(lamp.colour == "red");
  CHECK(lamp.delay == std::chrono::seconds(60));
  CHECK(lamp.memory_bytes == std::uint64_t{5} << 20);
}

TEST_CASE("an unknown key is refused with its line and the nearest known key") {
  const auto errors = errors_of("[lamp]\ncount = 2\nheigth_m = 3\n");
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].field == "lamp.heigth_m");
  CHECK(errors[0].message == "line 3: unknown key; did you mean lamp.height_m?");
}

TEST_CASE("an unknown table is refused as a whole") {
  const auto errors = errors_of("[lmap]\ncount = 2\nlit = true\n");
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message == "line 1: unknown table; did you mean lamp?");
}

TEST_CASE("a number out of its range is refused with the range") {
  const auto errors = errors_of("[lamp]\ncount = 10\nheight_m = nan\n[timing]\nmemory_mib = 0\n");
  REQUIRE(errors.size() == 3);
  CHECK(errors[0].message == "line 3: must be 0.5 to 12, not nan");
  CHECK(errors[1].message == "line 2: must be 1 to 9, not 10");
  CHECK(errors[2].field == "timing.memory_mib");
}

TEST_CASE("a negative number for a count is out of range, not wrapped around") {
  CHECK(errors_of("[lamp]\ncount = -1\n")[0].message == "line 2: must be 1 to 9, not -1");
}

TEST_CASE("a value of the wrong type is refused, also one that could be converted") {
  CHECK(errors_of("[lamp]\ncount = 2.0\n")[0].message == "line 2: must be a whole number, not floating-point");
  CHECK(errors_of("[lamp]\ncount = '2'\n")[0].message == "line 2: must be a whole number, not string");
  CHECK(errors_of("[lamp]\nlit = 1\n")[0].message == "line 2: must be true or false, not integer");
  CHECK(errors_of("[lamp]\nheight_m = true\n")[0].message == "line 2: must be a number, not boolean");
  CHECK(errors_of("lamp = 3\n")[0].message == "line 1: must be a table, not integer");
}

TEST_CASE("a text that is none of the choices is refused with the choices") {
  CHECK(errors_of("[lamp]\ncolour = 'blue'\n")[0].message == R"(line 2: must be one of white, red, not "blue")");
}

TEST_CASE("all errors of a file are told at once") {
  CHECK(errors_of("[lamp]\ncount = 0\ncolour = 'blue'\nshape = 1\n[timing]\ndelay_s = 'long'\n").size() == 4);
}

TEST_CASE("a text that is no TOML is refused with its line") {
  const auto errors = errors_of("[lamp]\ncount = 1\ncount = 2\n");
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.find("line 3: ") == 0);
}

TEST_CASE("a file that is not there is refused") {
  CHECK_THROWS_WITH_AS(ConfigReader::open("/there/is/no/such.toml"), "/there/is/no/such.toml: there is no such file",
                       InvalidInput);
  CHECK_THROWS_WITH_AS(ConfigReader::open("/tmp"), "/tmp: is a directory, not a file", InvalidInput);
}

}  // namespace raywatch
