#include "tests/evaluate/nights.hpp"

#include <doctest/doctest.h>

using namespace raywatch;
using namespace raywatch::evaluation;

TEST_CASE("what happens in the nights is counted against the alerts") {
  std::size_t seen = 0;
  const NightsResult result =
      watch_nights({.seed = 2, .density = 0.2, .scans = 44, .rounds_apart = 8}, [&](std::size_t scan) { seen = scan; });
  CHECK(seen == 44);
  CHECK(result.scans == 44);
  REQUIRE(result.planted.size() == 2);  // a bag is left, a crate taken; the bag goes again
  CHECK(result.planted[0].kind == ChangeKind::added);
  CHECK(result.planted[1].kind == ChangeKind::removed);
  CHECK(result.passers == 3);
  CHECK(result.planted[1].alerts == 1);
  CHECK(result.told(0) + result.told(1) == 2);
}
