#include "storage/payloads.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "storage/payload_files.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

TEST_CASE_FIXTURE(StoreFixture, "points come back bit by bit and in order, whatever their number") {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, kChunkPoints - 1, kChunkPoints, 3 * kChunkPoints + 5}) {
    CAPTURE(size);
    PointCloud cloud = cloud_of(size, 1);
    const PayloadRef without = store.payloads().put_scan(site.id, at_second(0), cloud, empty_panorama());
    CHECK(same_bits(store.payloads().scan_points(without), cloud));
    cloud.intensity = cloud.x_m;
    cloud.grid = ShotGrid{1, static_cast<std::uint32_t>(size)};
    const PayloadRef with = store.payloads().put_scan(site.id, at_second(0), cloud, empty_panorama());
    CHECK(same_bits(store.payloads().scan_points(with), cloud));
    CHECK(store.payloads().stored_bytes(with) >= store.payloads().stored_bytes(without));
  }
}

TEST_CASE_FIXTURE(StoreFixture, "the panorama comes back as it was") {
  Panorama panorama = empty_panorama();
  for (std::size_t i = 0; i < panorama.farthest.size(); ++i) panorama.farthest[i] = static_cast<std::uint16_t>(i * 7);
  const PayloadRef ref = store.payloads().put_scan(site.id, at_second(0), cloud_of(5, 1), panorama);
  CHECK(store.payloads().scan_panorama(ref).farthest == panorama.farthest);
}

TEST_CASE_FIXTURE(StoreFixture, "the points of a comparison come back as they were") {
  ComparisonPoints points;
  points.classes = {PointClass::added, PointClass::unseen};
  points.free = {2, 0};
  points.supported = {1, 0};
  points.change_of = {0, -1};
  points.prior_points = {{.prior = 1, .index = 70'000, .point_class = PointClass::removed, .change = 3}};
  const PayloadRef ref = store.payloads().put_comparison(site.id, at_second(0), points);
  const ComparisonPoints read = store.payloads().comparison_points(ref);
  CHECK(read.classes == points.classes);
  CHECK(read.free == points.free);
  CHECK(read.supported == points.supported);
  CHECK(read.change_of == points.change_of);
  REQUIRE(read.prior_points.size() == 1);
  CHECK(read.prior_points[0].index == 70'000);
}

TEST_CASE_FIXTURE(StoreFixture, "payloads stand in one file a site and month of capture") {
  CHECK(payload_file_name(SiteId{3}, at_second(0)) == "payload/3/2026-01.db");
  CHECK(payload_file_name(SiteId{3}, at_second(-1)) == "payload/3/2025-12.db");
  const PayloadRef ref = store.payloads().put_scan(site.id, at_second(0), cloud_of(5, 1), empty_panorama());
  CHECK(ref.file == payload_file_name(site.id, at_second(0)));
  CHECK(std::filesystem::exists(store.data_dir() / ref.file));
}

TEST_CASE_FIXTURE(StoreFixture, "more months than connections can be written and read in turns") {
  constexpr std::int64_t kMonth_s = 31 * 86'400;
  std::vector<PayloadRef> refs;
  for (std::uint32_t month = 0; month < 24; ++month) {
    refs.push_back(
        store.payloads().put_scan(site.id, at_second(month * kMonth_s), cloud_of(9, month), empty_panorama()));
  }
  for (int round = 0; round < 2; ++round) {
    for (std::uint32_t month = 0; month < 24; ++month) {
      CHECK(same_bits(store.payloads().scan_points(refs[month]), cloud_of(9, month)));
    }
  }
}

TEST_CASE_FIXTURE(StoreFixture, "a payload that is not there is not found, and removing it is no error") {
  const PayloadRef ref = store.payloads().put_scan(site.id, at_second(0), cloud_of(5, 1), empty_panorama());
  const PayloadRef other = store.payloads().put_scan(site.id, at_second(0), cloud_of(5, 2), empty_panorama());
  store.payloads().remove(ref);
  store.payloads().remove(ref);
  CHECK_THROWS_AS(store.payloads().scan_points(ref), NotFound);
  CHECK_THROWS_AS(store.payloads().scan_points({"payload/9/2026-01.db", 1}), NotFound);
  CHECK_THROWS_AS(store.payloads().scan_points({}), NotFound);
  CHECK_THROWS_AS(store.payloads().comparison_points(other), NotFound);
  store.payloads().remove({"payload/9/2026-01.db", 1});
  CHECK(same_bits(store.payloads().scan_points(other), cloud_of(5, 2)));
}

TEST_CASE_FIXTURE(StoreFixture, "planes of different lengths are refused") {
  PointCloud cloud = cloud_of(5, 1);
  cloud.intensity = {1.0f};
  CHECK_THROWS_AS(store.payloads().put_scan(site.id, at_second(0), cloud, empty_panorama()), InvalidInput);
}

TEST_CASE_FIXTURE(StoreFixture, "a question about one direction reads few chunks, and all points of that direction") {
  // A ring: a full turn in the order of azimuth, 40 chunks.
  constexpr std::size_t kPoints = 40 * kChunkPoints;
  PointCloud ring;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double azimuth_rad = (2.0 * static_cast<double>(i) / kPoints - 1.0) * 3.141592653589793;
    ring.push_back(static_cast<float>(9.0 * std::cos(azimuth_rad)), static_cast<float>(9.0 * std::sin(azimuth_rad)),
                   1.0f);
  }
  const PayloadRef ref = store.payloads().put_scan(site.id, at_second(0), ring, empty_panorama());
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(0.0, 9.0, 1.0), Eigen::Vector3d(-9.0, 0.0, 1.0)}) {
    const std::vector<PointCloud> chunks = store.payloads().scan_points_around(ref, {direction, 0.01});
    CHECK(chunks.size() <= 3);
    std::size_t found = 0, wanted = 0;
    const auto near = [&](const Eigen::Vector3f& p) {
      return p.cast<double>().normalized().dot(direction.normalized()) > std::cos(0.01);
    };
    for (const PointCloud& chunk : chunks) {
      for (std::size_t i = 0; i < chunk.size(); ++i) found += near(chunk[i]) ? 1u : 0u;
    }
    for (std::size_t i = 0; i < ring.size(); ++i) wanted += near(ring[i]) ? 1u : 0u;
    CHECK(found == wanted);
    CHECK(wanted > 0);
  }
}

}  // namespace
}  // namespace raywatch
