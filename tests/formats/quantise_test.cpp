#include "storage/formats/quantise.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "storage/formats/write.hpp"
#include "tests/formats/sample_files.hpp"

using namespace raywatch;
using namespace raywatch::test;

namespace {

constexpr std::size_t kHeaderBytes = 96, kPointBytes = 8;

std::string written(const PointTable& table) {
  std::ostringstream out;
  write_points(out, PointFormat::q16, table);
  return out.str();
}

template <class T>
T value_at(const std::string& bytes, std::size_t at) {
  T value{};
  REQUIRE_LE(at + sizeof(T), bytes.size());
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// A coordinate as a reader of the format computes it.
double coordinate(const std::string& bytes, std::size_t point, std::size_t axis) {
  const auto origin_m = value_at<double>(bytes, 32 + 8 * axis);
  const auto step_m = value_at<double>(bytes, 56 + 8 * axis);
  return origin_m + step_m * value_at<std::uint16_t>(bytes, kHeaderBytes + kPointBytes * point + 2 * axis);
}

}  // namespace

TEST_CASE("quantised points have the golden bytes") {
  const std::vector<float> x = {1.0F, 3.0F, 2.0F}, y = {0.0F, 0.0F, 0.0F}, z = {-1.0F, 1.0F, kNan};
  const std::vector<std::uint8_t> classes = {0, 2, 1};
  const std::vector<float> intensity = {10.0F, 20.0F, 15.0F};
  PointTable table{.x_m = x,
                   .y_m = y,
                   .z_m = z,
                   .columns = {{"intensity", std::span(intensity)}, {"class", std::span(classes)}},
                   .origin_m = {100.0, 0.0, 0.5}};
  const std::string expected = "RWPQ" + bits(std::uint32_t{1}) + bits(std::uint64_t{2}) + bits(std::uint64_t{2}) +
                               bits(std::uint64_t{0}) + bits(101.0) + bits(0.0) + bits(-0.5) + bits(2.0 / 65535.0) +
                               bits(0.0) + bits(2.0 / 65535.0) + bits(10.0F) + bits(20.0F) + bits(std::uint32_t{3}) +
                               bits(std::uint32_t{0}) + std::string("\0\0\0\0\0\0\0\0", 8) + "\xFF\xFF" +
                               std::string("\0\0", 2) + "\xFF\xFF\x02\xFF";
  CHECK(written(table) == expected);
  CHECK(written({.x_m = {}, .y_m = {}, .z_m = {}}).size() == kHeaderBytes);
}

TEST_CASE("a quantised coordinate lies within half a step of the measured one") {
  CHECK(rc::check([] {
    const auto coordinates = *rc::gen::container<std::vector<std::array<std::int32_t, 3>>>(
        rc::gen::arbitrary<std::array<std::int32_t, 3>>());
    std::vector<std::vector<float>> planes(3);
    for (const auto& point : coordinates) {
      for (std::size_t axis = 0; axis < 3; ++axis) planes[axis].push_back(static_cast<float>(point[axis]) * 1e-4F);
    }
    const Eigen::Vector3d origin_m(423'000.0, 5'462'000.0, 200.0);
    const std::string bytes = written({.x_m = planes[0], .y_m = planes[1], .z_m = planes[2], .origin_m = origin_m});
    RC_ASSERT(bytes.size() == kHeaderBytes + kPointBytes * coordinates.size());
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double measured_m = static_cast<double>(planes[axis][i]) + origin_m[static_cast<Eigen::Index>(axis)];
        const double allowed_m = value_at<double>(bytes, 56 + 8 * axis) / 2.0 + 1e-8;
        RC_ASSERT(std::abs(coordinate(bytes, i, axis) - measured_m) <= allowed_m);
      }
    }
  }));
}
