#include "storage/class_codec.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include "core/error.hpp"

namespace raywatch {
namespace {

bool same(const ComparisonPoints& a, const ComparisonPoints& b) {
  const auto same_point = [](const PriorPoint& p, const PriorPoint& q) {
    return p.prior == q.prior && p.index == q.index && p.point_class == q.point_class && p.change == q.change;
  };
  return a.classes == b.classes && a.free == b.free && a.supported == b.supported && a.change_of == b.change_of &&
         std::equal(a.prior_points.begin(), a.prior_points.end(), b.prior_points.begin(), b.prior_points.end(),
                    same_point);
}

ComparisonPoints points_of(std::size_t size, std::size_t prior_points) {
  ComparisonPoints points;
  for (std::size_t i = 0; i < size; ++i) {
    points.classes.push_back(static_cast<PointClass>(i % kPointClasses));
    points.free.push_back(static_cast<std::uint8_t>(i % 251));
    points.supported.push_back(static_cast<std::uint8_t>(i % 5));
    points.change_of.push_back(static_cast<std::int32_t>(i % 100) - 1);
  }
  for (std::size_t i = 0; i < prior_points; ++i) {
    const auto n = static_cast<std::uint32_t>(i);
    points.prior_points.push_back({n % 4, n * 3, PointClass::removed, static_cast<std::int32_t>(n % 7)});
  }
  return points;
}

ComparisonPoints decoded(const std::vector<std::vector<std::uint8_t>>& blocks) {
  ComparisonPoints points;
  for (const std::vector<std::uint8_t>& block : blocks) decode_class_block(block, points);
  return points;
}

TEST_CASE("the classes of points come back as they were, over several blocks") {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, kClassBlockElements, kClassBlockElements + 1}) {
    const ComparisonPoints points = points_of(size, size);
    CHECK(same(decoded(encode_classes(points)), points));
  }
}

TEST_CASE("a flipped byte anywhere in a block of classes is noticed") {
  for (const std::vector<std::uint8_t>& block : encode_classes(points_of(60, 60))) {
    for (std::size_t place = 0; place < block.size(); ++place) {
      std::vector<std::uint8_t> damaged = block;
      damaged[place] = static_cast<std::uint8_t>(damaged[place] ^ 0x10);
      ComparisonPoints points;
      REQUIRE_THROWS_AS(decode_class_block(damaged, points), CorruptData);
    }
  }
}

TEST_CASE("any bytes but a block are refused without a crash") {
  CHECK(rc::check("any bytes", [](const std::vector<std::uint8_t>& bytes) {
    ComparisonPoints points;
    RC_ASSERT_THROWS_AS(decode_class_block(bytes, points), CorruptData);
  }));
}

TEST_CASE("a class that does not exist is refused though its checksum is right") {
  ComparisonPoints points = points_of(3, 0);
  points.classes[1] = static_cast<PointClass>(kPointClasses);
  CHECK_THROWS_AS(decoded(encode_classes(points)), CorruptData);
}

TEST_CASE("planes of different lengths are refused") {
  ComparisonPoints points = points_of(3, 0);
  points.free.pop_back();
  CHECK_THROWS_AS(encode_classes(points), InvalidInput);
}

}  // namespace
}  // namespace raywatch
