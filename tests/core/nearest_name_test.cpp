#include "core/nearest_name.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace raywatch {

TEST_CASE("the distance of words counts letters that are missing, too many, wrong or swapped") {
  CHECK(edit_distance("port", "port") == 0);
  CHECK(edit_distance("prt", "port") == 1);
  CHECK(edit_distance("portt", "port") == 1);
  CHECK(edit_distance("pork", "port") == 1);
  CHECK(edit_distance("prot", "port") == 1);
  CHECK(edit_distance("", "port") == 4);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the nearest name is suggested only when it is near") {
  const std::vector<std::string> known = {"http.host", "http.port", "log.level"};
  CHECK(nearest_name("http.prot", known) == "http.port");
  CHECK(nearest_name("log.levle", known) == "log.level");
  CHECK_FALSE(nearest_name("storage.data_dir", known).has_value());
  CHECK_FALSE(nearest_name("anything", {}).has_value());
}

TEST_CASE("a name that goes on is meant before one that looks alike, and short names are near only by one letter") {
  const std::vector<std::string> limits = {"max_bytes", "min_free_bytes", "max_age_days"};
  CHECK(nearest_name("max_age", limits) == "max_age_days");
  CHECK(nearest_name("max_age_days_", limits) == "max_age_days");
  const std::vector<std::string> short_names = {"by", "note", "until"};
  CHECK_FALSE(nearest_name("to", short_names).has_value());
  CHECK_FALSE(nearest_name("pose", short_names).has_value());
  CHECK(nearest_name("nota", short_names) == "note");
  CHECK_FALSE(nearest_name("storage.max_bytes", std::vector<std::string>{"storage.data_dir"}).has_value());
}

TEST_CASE("a suggestion is the name that was meant, else all that there are") {
  const std::vector<std::string> known = {"by", "note"};
  CHECK(suggestion("nota", known) == "; did you mean 'note'?");
  CHECK(suggestion("to", known) == "; known are by, note");
  CHECK(suggestion("to", {}) == "; none is known here");
}

}  // namespace raywatch
