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

}  // namespace raywatch
