#include "storage/chunk_codec.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

constexpr double kPi = std::numbers::pi;

/// Any bit patterns, so also infinities, denormals and NaNs of every kind.
PointCloud any_cloud(bool with_intensity) {
  const auto planes =
      *rc::gen::nonEmpty(rc::gen::arbitrary<std::vector<std::array<std::uint32_t, 4>>>()).as("bits of points");
  PointCloud cloud;
  for (const auto& bits : planes) {
    cloud.push_back(std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]), std::bit_cast<float>(bits[2]));
    if (with_intensity) cloud.intensity.push_back(std::bit_cast<float>(bits[3]));
  }
  return cloud;
}

std::vector<std::uint8_t> encoded(const PointCloud& cloud) {
  BlockSealer sealer;
  return encode_chunk(cloud, 0, cloud.size(), sealer);
}

std::optional<ChunkBounds> bounds_of(const PointCloud& cloud) { return chunk_bounds(cloud.x_m, cloud.y_m, cloud.z_m); }

PointCloud points_at(std::initializer_list<double> azimuths_deg) {
  PointCloud cloud;
  for (const double azimuth_deg : azimuths_deg) {
    const double azimuth_rad = azimuth_deg * kPi / 180.0;
    cloud.push_back(static_cast<float>(5.0 * std::cos(azimuth_rad)), static_cast<float>(5.0 * std::sin(azimuth_rad)),
                    0.0f);
  }
  return cloud;
}

TEST_CASE("a chunk gives back every bit of every float, NaNs included") {
  CHECK(rc::check("any bit patterns", [](bool with_intensity) {
    const PointCloud cloud = any_cloud(with_intensity);
    PointCloud decoded;
    decode_chunk(encoded(cloud), with_intensity, decoded);
    RC_ASSERT(same_bits(decoded, cloud));
  }));
}

TEST_CASE("a flipped byte anywhere in a chunk is noticed, and nothing of it is taken") {
  const std::vector<std::uint8_t> block = encoded(cloud_of(200, 1));
  for (std::size_t place = 0; place < block.size(); ++place) {
    for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
      std::vector<std::uint8_t> damaged = block;
      damaged[place] = static_cast<std::uint8_t>(damaged[place] ^ flip);
      PointCloud decoded;
      REQUIRE_THROWS_AS(decode_chunk(damaged, false, decoded), CorruptData);
      REQUIRE(decoded.empty());
    }
  }
}

TEST_CASE("a chunk that was cut short at any place is noticed") {
  const std::vector<std::uint8_t> block = encoded(cloud_of(50, 2));
  for (std::size_t size = 0; size < block.size(); ++size) {
    PointCloud decoded;
    REQUIRE_THROWS_AS(decode_chunk(std::span(block).first(size), false, decoded), CorruptData);
  }
}

TEST_CASE("a chunk whose checksum is right but whose header lies is noticed") {
  BlockSealer sealer;
  const std::vector<std::uint8_t> content(120);  // 10 points
  const auto block_of = [&](std::uint32_t elements, std::uint8_t flags) {
    return sealer.seal({.kind = BlockKind::scan_points, .flags = flags, .elements = elements}, content);
  };
  PointCloud decoded;
  for (const std::uint32_t elements : {0u, 9u, 11u, 8193u, 0xffffffffu}) {
    CAPTURE(elements);
    CHECK_THROWS_AS(decode_chunk(block_of(elements, 0), false, decoded), CorruptData);
  }
  CHECK_THROWS_AS(decode_chunk(block_of(10, 1), false, decoded), CorruptData);
  CHECK_THROWS_AS(decode_chunk(block_of(10, 0), true, decoded), CorruptData);
  decode_chunk(block_of(10, 0), false, decoded);
  CHECK(decoded.size() == 10);
}

TEST_CASE("azimuth bounds go over the seam when the points do") {
  const std::optional<ChunkBounds> bounds = bounds_of(points_at({170.0, 179.0, -179.0, -160.0}));
  REQUIRE(bounds.has_value());
  CHECK(bounds->azimuth_min_rad == doctest::Approx(170.0 * kPi / 180.0));
  CHECK(bounds->azimuth_max_rad == doctest::Approx(200.0 * kPi / 180.0));
  CHECK(bounds->range_min_m == doctest::Approx(5.0));
}

TEST_CASE("points without a direction have no part in the bounds") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  PointCloud cloud;
  cloud.push_back(kNan, 1.0f, 1.0f);
  cloud.push_back(0.0f, 0.0f, 0.0f);
  cloud.push_back(std::numeric_limits<float>::infinity(), 0.0f, 0.0f);
  CHECK_FALSE(bounds_of(cloud).has_value());
  cloud.push_back(3.0f, 0.0f, 4.0f);
  const std::optional<ChunkBounds> bounds = bounds_of(cloud);
  REQUIRE(bounds.has_value());
  CHECK(bounds->range_max_m == doctest::Approx(5.0));
  CHECK(bounds->elevation_min_rad == doctest::Approx(std::atan2(4.0, 3.0)));
}

TEST_CASE("no cone that holds a point of a chunk misses its bounds") {
  CHECK(rc::check("points anywhere, cones anywhere", [] {
    const auto angle = [](int limit) { return *rc::gen::inRange(-limit, limit + 1) * kPi / 1800.0; };
    const auto count = *rc::gen::inRange(1, 20);
    PointCloud cloud;
    for (int i = 0; i < count; ++i) {
      const double azimuth_rad = angle(1800), elevation_rad = angle(900);
      cloud.push_back(static_cast<float>(std::cos(elevation_rad) * std::cos(azimuth_rad)),
                      static_cast<float>(std::cos(elevation_rad) * std::sin(azimuth_rad)),
                      static_cast<float>(std::sin(elevation_rad)));
    }
    const double azimuth_rad = angle(1800), elevation_rad = angle(900);
    const Eigen::Vector3d u(std::cos(elevation_rad) * std::cos(azimuth_rad),
                            std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad));
    const DirectionCone cone{u, std::abs(angle(1800))};
    bool holds_one = false;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d v = cloud[i].cast<double>();
      holds_one = holds_one || std::atan2(u.cross(v).norm(), u.dot(v)) <= cone.half_angle_rad;
    }
    if (holds_one) RC_ASSERT(may_meet(bounds_of(cloud).value(), cone));
  }));
}

TEST_CASE("a narrow cone away from a chunk misses its bounds") {
  const ChunkBounds bounds = bounds_of(points_at({170.0, -170.0})).value();
  CHECK_FALSE(may_meet(bounds, {Eigen::Vector3d(1.0, 0.0, 0.0), 0.01}));
  CHECK_FALSE(may_meet(bounds, {Eigen::Vector3d(0.0, 0.0, 1.0), 0.5}));
  CHECK(may_meet(bounds, {Eigen::Vector3d(-1.0, 0.0, 0.0), 0.01}));
}

}  // namespace
}  // namespace raywatch
