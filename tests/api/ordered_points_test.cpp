#include "api/ordered_points.hpp"

#include <doctest/doctest.h>

#include <string>

namespace raywatch {
namespace {

PointSet row_of(int points) {
  PointSet set;
  for (int i = 0; i < points; ++i) {
    set.push_back({static_cast<float>(i), 0.0F, 0.0F});
    set.change.push_back(i);
  }
  return set;
}

TEST_CASE("the parts of a set are the set, gathered once, whatever their sizes") {
  OrderedPoints kept(1 << 20);
  int gathered = 0;
  const auto gather = [&] {
    ++gathered;
    return row_of(1000);
  };
  const auto part = [&](std::size_t skip, std::size_t budget) {
    return requested_points(kept, "row", {.budget = budget, .skip = skip}, gather);
  };
  const auto all = part(0, 5000);
  REQUIRE(all->size() == 1000);
  CHECK(all->quantisation->total == 1000);
  const auto first = part(0, 300), second = part(300, 500), last = part(800, 500), none = part(2000, 10);
  CHECK(gathered == 1);
  CHECK(second->quantisation->first == 300);
  CHECK(none->size() == 0);
  std::vector<std::int32_t> joined = first->change;
  joined.insert(joined.end(), second->change.begin(), second->change.end());
  joined.insert(joined.end(), last->change.begin(), last->change.end());
  CHECK(joined == all->change);
}

TEST_CASE("without a budget nothing is ordered or kept") {
  OrderedPoints kept(1 << 20);
  const auto set = requested_points(kept, "row", {}, [] { return row_of(10); });
  CHECK(set->change == row_of(10).change);
  CHECK_FALSE(set->quantisation.has_value());
}

TEST_CASE("the sets that were used last are kept within the limit") {
  OrderedPoints kept(2 * bytes_of(row_of(100)) + 10);
  int built = 0;
  const auto get = [&](const std::string& key, int points) {
    return kept.get(key, [&] {
      ++built;
      return row_of(points);
    });
  };
  get("a", 100);
  get("b", 100);
  get("a", 100);
  CHECK(built == 2);
  get("c", 100);  // b goes
  get("a", 100);
  CHECK(built == 3);
  get("b", 100);
  CHECK(built == 4);
  CHECK(get("large", 1000)->size() == 1000);  // given, not kept
  get("large", 1000);
  CHECK(built == 6);
  get("b", 100);
  CHECK(built == 6);
}

}  // namespace
}  // namespace raywatch
