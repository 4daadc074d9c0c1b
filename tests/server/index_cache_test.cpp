#include "server/index_cache.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <latch>
#include <thread>
#include <vector>

#include "core/error.hpp"

namespace raywatch {
namespace {

IndexKey key(std::int64_t scan) { return {ScanId{scan}, UsableRange{}}; }

IndexedScan small_scan() {
  PointCloud points;
  for (int i = 0; i < 100; ++i) points.push_back(5.0f, 0.01f * static_cast<float>(i), 0.0f);
  PriorIndex index = PriorIndex::build(points, {});
  return {std::move(points), std::move(index)};
}

/// Counts how often it was asked to build.
struct Builder {
  std::atomic<int> builds{0};
  IndexCache::Build build = [this] {
    ++builds;
    return small_scan();
  };
};

}  // namespace

TEST_CASE("a scan is built once and then found") {
  IndexCache cache(1 << 30);
  Builder builder;
  const auto first = cache.get(key(1), builder.build);
  const auto second = cache.get(key(1), builder.build);
  CHECK(first == second);
  CHECK(builder.builds == 1);
  CHECK(cache.status().hits == 1);
  CHECK(cache.status().misses == 1);
  CHECK(cache.status().bytes == first->bytes());
}

TEST_CASE("a scan that is in memory already is not built, and what is here stays") {
  IndexCache cache(1 << 30);
  Builder builder;
  cache.put(key(1), small_scan());
  const auto found = cache.get(key(1), builder.build);
  CHECK(builder.builds == 0);
  CHECK(cache.status().bytes == found->bytes());
  cache.put(key(1), small_scan());
  CHECK(cache.get(key(1), builder.build) == found);
  CHECK(cache.status().bytes == found->bytes());
  IndexCache none(0);
  none.put(key(1), small_scan());
  CHECK(none.status().bytes == 0);
}

TEST_CASE("the same scan with another usable range is another index") {
  IndexCache cache(1 << 30);
  Builder builder;
  cache.get({ScanId{1}, UsableRange{}}, builder.build);
  cache.get({ScanId{1}, UsableRange{.min_m = 0.5}}, builder.build);
  cache.get({ScanId{1}, UsableRange{.no_return_m = 32.0}}, builder.build);
  CHECK(builder.builds == 3);
}

TEST_CASE("when there is no room, the scan that was used longest ago goes") {
  Builder builder;
  const std::uint64_t one = small_scan().bytes();
  IndexCache cache(2 * one);
  cache.get(key(1), builder.build);
  cache.get(key(2), builder.build);
  cache.get(key(1), builder.build);
  cache.get(key(3), builder.build);  // 2 goes
  CHECK(builder.builds == 3);
  CHECK(cache.status().bytes <= 2 * one);
  cache.get(key(1), builder.build);
  CHECK(builder.builds == 3);
  cache.get(key(2), builder.build);
  CHECK(builder.builds == 4);
}

TEST_CASE("a scan that is larger than the cache can be used all the same") {
  IndexCache cache(1);
  Builder builder;
  CHECK(cache.get(key(1), builder.build)->points.size() == 100);
  CHECK(cache.status().bytes == 0);
}

TEST_CASE("threads that ask for one scan at once share one build") {
  IndexCache cache(1 << 30);
  Builder builder;
  std::latch all_there(4);
  std::vector<std::shared_ptr<const IndexedScan>> got(4);
  {
    std::vector<std::jthread> threads;
    for (auto& scan : got) {
      threads.emplace_back([&] {
        all_there.arrive_and_wait();
        scan = cache.get(key(1), builder.build);
      });
    }
  }
  CHECK(builder.builds == 1);
  for (const auto& scan : got) CHECK(scan == got.front());
}

TEST_CASE("a build that fails fails for its caller, and the next one builds again") {
  IndexCache cache(1 << 30);
  Builder builder;
  const auto fail = []() -> IndexedScan { throw CorruptData("broken"); };
  CHECK_THROWS_AS(cache.get(key(1), fail), CorruptData);
  CHECK(cache.get(key(1), builder.build)->points.size() == 100);
  CHECK(builder.builds == 1);
}

TEST_CASE("a scan that was forgotten is built again") {
  IndexCache cache(1 << 30);
  Builder builder;
  cache.get(key(1), builder.build);
  cache.forget(ScanId{1});
  CHECK(cache.status().bytes == 0);
  cache.get(key(1), builder.build);
  CHECK(builder.builds == 2);
}

}  // namespace raywatch
