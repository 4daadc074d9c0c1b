// Times, poses, panoramas, boxes: the small values.

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "core/change.hpp"
#include "core/error.hpp"
#include "core/panorama.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace raywatch {
namespace {

using namespace std::chrono_literals;

TEST_CASE("a time survives being written and read again, to the nanosecond") {
  CHECK(rc::check([](std::int64_t ns) {
    const Time time{std::chrono::nanoseconds{ns % 9'000'000'000'000'000'000}};
    RC_ASSERT(parse_rfc3339(format_rfc3339(time)) == time);
  }));
}

TEST_CASE("times are read with any offset and any fraction, and written in UTC without idle zeros") {
  CHECK(format_rfc3339(parse_rfc3339("2026-03-01T02:10:00+01:00")) == "2026-03-01T01:10:00Z");
  CHECK(format_rfc3339(parse_rfc3339("2026-03-01t02:10:00.2500z")) == "2026-03-01T02:10:00.25Z");
  CHECK(format_rfc3339(parse_rfc3339("2026-03-01 02:10:00.1234567899Z")) == "2026-03-01T02:10:00.123456789Z");
  CHECK(format_rfc3339(parse_rfc3339("2024-02-29T23:59:60Z")) == "2024-03-01T00:00:00Z");
  CHECK(format_rfc3339(parse_rfc3339("1950-01-01T00:00:00-00:30")) == "1950-01-01T00:30:00Z");
}

TEST_CASE("what is no time is refused with what would be one") {
  for (const char* text :
       {"", "yesterday", "2026-03-01", "2026-03-01T02:10:00", "2026-13-01T02:10:00Z", "2026-02-30T02:10:00Z",
        "2026-03-01T24:10:00Z", "2026-03-01T02:10:00.Z", "2026-03-01T02:10:00Zx", "1677-01-01T00:00:00Z",
        "2262-01-01T00:00:00Z", "2026-03-01T02:10:00+1:00", "2026-03-01T02:10:00+25:00"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_rfc3339(text), InvalidInput);
  }
}

TEST_CASE("times farther apart than a duration reaches keep their order, and none overflows") {
  const Time first = parse_rfc3339("1678-01-01T00:00:00Z"), last = parse_rfc3339("2261-12-31T23:59:59Z");
  CHECK(between(first, last) == Duration::max());
  CHECK(between(last, first) == -Duration::max());
  CHECK(std::chrono::abs(between(Time::max(), Time::min())) == Duration::max());
  CHECK(between(Time{}, Time::min()) == -Duration::max());
  CHECK(between(first, first + 5s) == 5s);
  CHECK(between(first + 5s, first) == -5s);
  CHECK(shifted(first, 5s) == first + 5s);
  CHECK(shifted(first, -std::chrono::days(3650)) == Time::min());
  CHECK(shifted(last, std::chrono::days(3650)) == Time::max());
}

TEST_CASE("a pose and its inverse cancel out") {
  const Pose world_from_a{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized())),
                          {4, -5, 6}};
  const Eigen::Vector3d point(0.3, 12.0, -7.0);
  CHECK((world_from_a.inverse() * (world_from_a * point) - point).norm() < 1e-12);
  CHECK(((world_from_a * world_from_a.inverse()) * point - point).norm() < 1e-12);
  CHECK(angle_between_rad(world_from_a, Pose{}) == doctest::Approx(0.7));
}

TEST_CASE("a pose of a user must be finite and a rotation; small errors of its norm are mended") {
  CHECK_THROWS_AS(checked_pose({0, 0, 0}, {0, 0, 0, 2}, "pose"), InvalidInput);
  CHECK_THROWS_AS(checked_pose({0, 0, 0}, {0, 0, 0, 0}, "pose"), InvalidInput);
  CHECK_THROWS_AS(checked_pose({0, std::nan(""), 0}, {0, 0, 0, 1}, "pose"), InvalidInput);
  CHECK_THROWS_AS(checked_pose({0, 0, 0}, {0, 0, 0, std::nan("")}, "pose"), InvalidInput);
  CHECK_THROWS_WITH_AS(checked_pose({0, 0, 0}, {0, 0, 0, 2}, "pose"),
                       doctest::Contains("must be a unit quaternion x, y, z, w; its norm is 2.0"), InvalidInput);
  CHECK(checked_pose({1, 2, 3}, {0, 0, 0, 1.0005}, "pose").orientation.norm() == doctest::Approx(1.0).epsilon(1e-15));
}

TEST_CASE("a position may have any coordinates of a map, but none that no place on Earth has") {
  const auto complaint = [](const Eigen::Vector3d& position_m) {
    try {
      checked_pose(position_m, {0, 0, 0, 1}, "pose");
    } catch (const InvalidInput& error) {
      return error.fields().front().message;
    }
    return std::string("none");
  };
  const Eigen::Vector3d in_a_zone_m(32'401'000.0, 5'502'000.0, 120.0),
      geocentric_m(-2'694'045.0, -4'293'642.0, 3'857'878.0);
  CHECK(complaint(in_a_zone_m) == "none");
  CHECK(complaint(geocentric_m) == "none");
  const std::string limit = "must have a position within 1e8 m of the origin of the coordinates, on each axis";
  CHECK(complaint({401'000'000.0, 0.0, 0.0}) == limit);
  CHECK(complaint({0.0, -1e30, 0.0}) == limit);
}

TEST_CASE("a panorama covers what lies before the farthest return of a direction, and nothing beyond or elsewhere") {
  PointCloud wall;
  for (int y = -20; y <= 20; ++y) {
    for (int z = -20; z <= 20; ++z) wall.push_back(10.0f, 0.1f * static_cast<float>(y), 0.1f * static_cast<float>(z));
  }
  const Panorama panorama = make_panorama(wall, {});
  const Pose sensor_from_world;
  const auto covers = [&](const Eigen::Vector3d& point_m) {
    return covered(panorama, sensor_from_world, {&point_m, 1}).front() == 1;
  };
  CHECK(covers({5.0, 0.1, 0.1}));
  CHECK(covers({10.0, 0.1, 0.1}));
  CHECK_FALSE(covers({12.0, 0.1, 0.1}));
  CHECK_FALSE(covers({-5.0, 0.1, 0.1}));
  CHECK_FALSE(covers({0.1, 0.1, 8.0}));
  CHECK(panorama_from_bytes(to_bytes(panorama)).farthest == panorama.farthest);
  CHECK_THROWS_AS(panorama_from_bytes(std::vector<std::uint8_t>(17)), CorruptData);
}

TEST_CASE("unusable returns cover nothing") {
  PointCloud cloud;
  cloud.push_back(0.0f, 0.0f, 0.0f);
  cloud.push_back(std::nanf(""), 0.0f, 1.0f);
  cloud.push_back(500.0f, 0.0f, 0.0f);
  const Panorama panorama = make_panorama(cloud, {.max_m = 100.0});
  const Eigen::Vector3d ahead_m(1.0, 0.0, 0.0);
  CHECK(covered(panorama, Pose{}, {&ahead_m, 1}).front() == 0);
}

TEST_CASE("the box around a turned box of points has its size and direction, longest side first") {
  CHECK(rc::check([] {
    const double angle = *rc::gen::inRange(0, 3141) / 1000.0;
    const Eigen::Vector3d size(0.4, 0.15, 0.9), center(100.0, -50.0, 3.0);
    const Eigen::AngleAxisd turn(angle, Eigen::Vector3d::UnitZ());
    Eigen::Matrix3Xd points(3, 8);
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d sign((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5, (corner & 4) ? 0.5 : -0.5);
      points.col(corner) = center + turn * size.cwiseProduct(sign);
    }
    const OrientedBox box = bounding_box(points);
    RC_ASSERT((box.size_m - size).norm() < 1e-9);
    RC_ASSERT((box.center_m - center).norm() < 1e-9);
    const Eigen::Vector3d axis = box.world_from_box * Eigen::Vector3d::UnitX();
    RC_ASSERT(std::abs(std::abs(axis.dot(turn * Eigen::Vector3d::UnitX())) - 1.0) < 1e-9);
  }));
}

TEST_CASE("boxes around one point, a line and equal points are flat, not broken") {
  Eigen::Matrix3Xd point(3, 1);
  point.col(0) = Eigen::Vector3d(1, 2, 3);
  CHECK(bounding_box(point).size_m.norm() == 0.0);
  Eigen::Matrix3Xd line(3, 3);
  line << 0, 1, 2, 0, 1, 2, 0, 0, 0;
  CHECK(bounding_box(line).size_m.x() == doctest::Approx(std::sqrt(8.0)));
  CHECK(bounding_box(line).size_m.y() == doctest::Approx(0.0));
  CHECK(bounding_box(point.replicate(1, 5)).center_m == Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace raywatch
