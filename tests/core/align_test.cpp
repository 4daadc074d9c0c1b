// Fitting scans onto each other: how well poses are found, what is left alone, and what is refused.

#include "core/align.hpp"

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <rapidcheck.h>

#include <map>
#include <numbers>

#include "tests/simulator/family.hpp"
#include "tests/simulator/registration.hpp"

namespace raywatch {
namespace {

using namespace simulator;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A simulated scan, indexed, with the pose that it is said to have.
struct Taken {
  SimulatedScan scan;
  SensorModel sensor;
  PriorIndex index;

  ScanView view(const Pose& world_from_sensor) const {
    return {scan.points, index, world_from_sensor, scan.captured_at, sensor};
  }
  ScanView at_true_pose() const { return view(scan.true_world_from_sensor); }
};

Taken taken(SimulatedScan scan) {
  PriorIndex index = PriorIndex::build(scan.points, {});
  const SensorModel sensor = estimate_sensor(scan.points, index);
  return {std::move(scan), sensor, std::move(index)};
}

/// Scans are made once: several tests look at the same ones. Thinned, so that they are quick to make.
const Taken& taken(Family family, std::size_t moment) {
  static std::map<Family, Timeline> timelines;
  static std::map<std::pair<Family, std::size_t>, Taken> scans;
  const FamilyOptions options{.seed = 3, .hard = false, .density = family == Family::mine ? 0.03 : 0.3};
  if (!timelines.contains(family)) timelines.emplace(family, make_timeline(family, options));
  const Timeline& timeline = timelines.at(family);
  const auto key = std::pair(family, moment);
  if (!scans.contains(key)) scans.emplace(key, taken(take_scan(timeline, timeline.moments.at(moment))));
  return scans.at(key);
}

Taken taken(const Scene& scene, const Pose& world_from_sensor, std::uint64_t seed) {
  Scanner scanner = grid_scanner({.step_rad = radians(1.0)});
  scanner.errors.range_noise_m = 0.01;
  return taken(take_scan(RayCaster(scene), scanner, exact_plan(world_from_sensor, seed)));
}

Alignment aligned(const Taken& scan, const Pose& said, const Taken& reference, const AlignParameters& with = {}) {
  const ScanView view = reference.at_true_pose();
  return align(scan.view(said), {&view, 1}, with);
}

/// How far the corrected pose is from the truth.
PoseUncertainty error_of(const Alignment& found, const Pose& said, const Taken& scan) {
  const Pose corrected = found.correction * said;
  return {(corrected.position_m - scan.scan.true_world_from_sensor.position_m).norm(),
          angle_between_rad(corrected, scan.scan.true_world_from_sensor)};
}

Pose from(double x, double y) { return {Eigen::Quaterniond::Identity(), {x, y, 0.0}}; }

Pose shifted(Pose pose, const Eigen::Vector3d& by_m) {
  pose.position_m += by_m;
  return pose;
}

Pose turned(Pose pose, double angle_rad, const Eigen::Vector3d& axis) {
  pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis)) * pose.orientation;
  return pose;
}

constexpr RegistrationError kUsualError{.position_sigma_m = 0.01, .angle_sigma_rad = 0.05 * kDegree};

TEST_CASE("the usual errors of a pose are found to 4 mm and 0.02 degrees, in scans of a third of the usual shots") {
  struct Pair {
    Family family;
    std::size_t scan, reference;
  };
  // Other times, and other stations where those see the same surfaces.
  for (const Pair pair : {Pair{Family::lab, 4, 0}, Pair{Family::lab, 3, 0}, Pair{Family::carpark, 3, 0},
                          Pair{Family::carpark, 4, 0}, Pair{Family::yard, 7, 1}}) {
    const Taken &scan = taken(pair.family, pair.scan), &reference = taken(pair.family, pair.reference);
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const Pose said = disturbed(scan.scan.true_world_from_sensor, kUsualError, seed);
      const Alignment found = aligned(scan, said, reference);
      const PoseUncertainty error = error_of(found, said, scan);
      CAPTURE(to_string(pair.family));
      CAPTURE(seed);
      CHECK(found.state == RegistrationState::good);
      CHECK(found.free_directions == 0);
      CHECK(error.position_m < 0.004);
      CHECK(error.angle_rad < 0.02 * kDegree);
      CHECK(error.position_m < 4.0 * found.uncertainty.position_m);
      CHECK(error.angle_rad < 4.0 * found.uncertainty.angle_rad);
    }
  }
}

TEST_CASE("exact poses stay as they are, to 4 mm and 0.02 degrees, and to twice of what the fit says") {
  for (const Family family : {Family::lab, Family::carpark}) {
    const Taken &scan = taken(family, 4), &reference = taken(family, 0);
    const Alignment found = aligned(scan, scan.scan.true_world_from_sensor, reference);
    const PoseUncertainty error = error_of(found, scan.scan.true_world_from_sensor, scan);
    CHECK(found.state == RegistrationState::good);
    CHECK(error.position_m < std::min(0.004, 2.0 * found.uncertainty.position_m));
    CHECK(error.angle_rad < 0.02 * kDegree);
    CHECK(found.inliers > 0.9);
  }
}

TEST_CASE("the pit's blasted bench does not pull the scans of the night after") {
  const Taken &scan = taken(Family::mine, 2), &reference = taken(Family::mine, 0);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Pose said = disturbed(scan.scan.true_world_from_sensor, kUsualError, seed);
    const Alignment found = aligned(scan, said, reference);
    CHECK(found.state == RegistrationState::good);
    CHECK(error_of(found, said, scan).position_m < 0.005);
    CHECK(error_of(found, said, scan).angle_rad < 0.005 * kDegree);
  }
}

TEST_CASE("a fixed sensor that was tilted by 3 mrad is moved, when its pose may be off by less") {
  const Taken &scan = taken(Family::yard, 7), &reference = taken(Family::yard, 1);
  const AlignParameters fixed{.tolerance = {.position_m = 0.03, .angle_rad = 0.002}};
  const Pose said = turned(scan.scan.true_world_from_sensor, 0.003, Eigen::Vector3d::UnitX());
  const Alignment found = aligned(scan, said, reference, fixed);
  CHECK(found.state == RegistrationState::moved);
  CHECK(size_of(found.correction, said).angle_rad == doctest::Approx(0.003).epsilon(0.1));
  CHECK(error_of(found, said, scan).angle_rad < 0.0003);
  CHECK(aligned(scan, scan.scan.true_world_from_sensor, reference, fixed).state == RegistrationState::good);
}

TEST_CASE("a pose that is off by far more than any error is found or refused, never made up") {
  const Taken &scan = taken(Family::lab, 4), &reference = taken(Family::lab, 0);
  const Pose truth = scan.scan.true_world_from_sensor;
  CHECK(aligned(scan, shifted(truth, {0.25, 0.1, 0.0}), reference).state == RegistrationState::moved);
  CHECK(aligned(scan, turned(truth, 1.0, Eigen::Vector3d::UnitZ()), reference).state == RegistrationState::bad);
  CHECK(rc::check([&] {
    const auto yaw_rad = *rc::gen::map(rc::gen::inRange(-314, 315), [](int n) { return n / 100.0; });
    const auto x_m = 0.1 * *rc::gen::inRange(-30, 31), y_m = 0.1 * *rc::gen::inRange(-30, 31);
    const Pose said = turned(shifted(truth, {x_m, y_m, 0.0}), yaw_rad, Eigen::Vector3d::UnitZ());
    const Alignment found = aligned(scan, said, reference);
    if (found.state == RegistrationState::good || found.state == RegistrationState::moved) {
      RC_ASSERT(error_of(found, said, scan).position_m < 0.01);
      RC_ASSERT(error_of(found, said, scan).angle_rad < 0.05 * kDegree);
    } else {
      RC_ASSERT(found.correction.position_m.isZero());
      RC_ASSERT(found.correction.orientation.angularDistance(Eigen::Quaterniond::Identity()) == 0.0);
    }
  }));
}

TEST_CASE("scans that have nothing in common are not aligned") {
  Scene scene;
  scene.add(Box{{Eigen::Quaterniond::Identity(), {20.0, 0.0, 0.0}}, Eigen::Vector3d(1.0, 10.0, 10.0)});
  scene.add(Box{{Eigen::Quaterniond::Identity(), {100.0, 0.0, 0.0}}, Eigen::Vector3d(1.0, 10.0, 10.0)});
  const Taken scan = taken(scene, from(0.0, 0.0), 1), other = taken(scene, from(60.0, 60.0), 2);
  CHECK(aligned(scan, scan.scan.true_world_from_sensor, other).state == RegistrationState::none);
  CHECK(align(scan.at_true_pose(), {}, {}).state == RegistrationState::none);
}

TEST_CASE("along a bare wall nothing is known, and nothing is corrected") {
  Scene wall;
  wall.add(Box{{Eigen::Quaterniond::Identity(), {6.0, 0.0, 0.0}}, Eigen::Vector3d(1.0, 60.0, 60.0)});
  const Taken scan = taken(wall, from(0.5, 0.5), 1), reference = taken(wall, from(0.0, 0.0), 2);
  const Pose truth = scan.scan.true_world_from_sensor;
  const Alignment found = aligned(scan, shifted(truth, {0.03, 0.04, -0.05}), reference);
  CHECK(found.state == RegistrationState::good);
  CHECK(found.free_directions == 3);
  const Eigen::Vector3d corrected_m = (found.correction * shifted(truth, {0.03, 0.04, -0.05})).position_m;
  CHECK(std::abs(corrected_m.x() - truth.position_m.x()) < 0.003);
  CHECK(std::abs(corrected_m.y() - truth.position_m.y() - 0.04) < 0.005);
  CHECK(std::abs(corrected_m.z() - truth.position_m.z() + 0.05) < 0.005);
  CHECK(found.uncertainty.position_m == doctest::Approx(AlignParameters{}.reported.position_m).epsilon(0.1));
}

TEST_CASE("along a corridor the way is not known, and everything else is") {
  Scene corridor;
  corridor.add(Room{Pose{}, {200.0, 1.5, 1.2}});
  const Taken scan = taken(corridor, from(3.0, 0.3), 1), reference = taken(corridor, from(0.0, 0.0), 2);
  const Pose truth = scan.scan.true_world_from_sensor;
  const Pose said = turned(shifted(truth, {0.05, 0.02, -0.02}), 0.1 * kDegree, Eigen::Vector3d::UnitZ());
  const Alignment found = aligned(scan, said, reference);
  const Pose corrected = found.correction * said;
  CHECK(found.state == RegistrationState::good);
  CHECK(found.free_directions == 1);
  CHECK(std::abs(corrected.position_m.x() - truth.position_m.x() - 0.05) < 0.005);
  CHECK(std::abs(corrected.position_m.y() - truth.position_m.y()) < 0.003);
  CHECK(std::abs(corrected.position_m.z() - truth.position_m.z()) < 0.003);
  CHECK(angle_between_rad(corrected, truth) < 0.02 * kDegree);
  CHECK(found.uncertainty.position_m > 0.9 * AlignParameters{}.reported.position_m);
}

TEST_CASE("a row of floor and one of the wall behind it are no piece of floor, and lift no scan of a large hall") {
  constexpr double kFloor_m = -5.0;
  Scene hall;
  hall.add(Box{{Eigen::Quaterniond::Identity(), {0.0, 0.0, kFloor_m - 0.5}}, Eigen::Vector3d(51.0, 51.0, 0.5)});
  for (const double side : {-1.0, 1.0}) {
    hall.add(Box{{Eigen::Quaterniond::Identity(), {50.0 * side, 0.0, 5.0}}, Eigen::Vector3d(0.5, 51.0, 11.0)});
    hall.add(Box{{Eigen::Quaterniond::Identity(), {0.0, 50.0 * side, 5.0}}, Eigen::Vector3d(51.0, 0.5, 11.0)});
  }
  const auto standing = [](double x, double y, double height_m) {
    return Pose{Eigen::Quaterniond::Identity(), {x, y, kFloor_m + height_m}};
  };
  const Taken scan = taken(hall, standing(-30.0, -38.0, 2.9), 1);
  for (const double height_m : {1.0, 1.3, 1.5, 1.6, 1.7, 1.8, 2.1}) {
    const Taken reference = taken(hall, standing(-33.5, 24.0, height_m), 2);
    const Pose truth = scan.scan.true_world_from_sensor;
    const Alignment found = aligned(scan, truth, reference);
    CAPTURE(height_m);
    CHECK(found.state == RegistrationState::good);
    CHECK(error_of(found, truth, scan).position_m < 0.015);
  }
}

TEST_CASE("the same bytes come out with one thread and with eight") {
  const Taken &scan = taken(Family::lab, 4), &reference = taken(Family::lab, 0);
  const Pose said = disturbed(scan.scan.true_world_from_sensor, kUsualError, 1);
  const auto with_threads = [&](int threads) {
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return aligned(scan, said, reference); });
  };
  const Alignment one = with_threads(1), eight = with_threads(8);
  CHECK(one.correction.position_m == eight.correction.position_m);
  CHECK(one.correction.orientation.coeffs() == eight.correction.orientation.coeffs());
  CHECK(one.residual_m == eight.residual_m);
  CHECK(one.uncertainty.position_m == eight.uncertainty.position_m);
}

TEST_CASE("a common rigid motion of the world moves the correction with it") {
  const Taken &scan = taken(Family::lab, 4), &reference = taken(Family::lab, 0);
  const Pose said = disturbed(scan.scan.true_world_from_sensor, kUsualError, 2);
  const Pose plain = aligned(scan, said, reference).correction * said;
  CHECK(rc::check([&] {
    const auto yaw_rad = *rc::gen::map(rc::gen::inRange(-314, 315), [](int n) { return n / 100.0; });
    const auto x_m = *rc::gen::inRange(-500, 501), y_m = *rc::gen::inRange(-500, 501);
    const Pose motion = turned(from(x_m, y_m), yaw_rad, Eigen::Vector3d::UnitZ());
    const ScanView there = reference.view(motion * reference.scan.true_world_from_sensor);
    const Alignment found = align(scan.view(motion * said), {&there, 1}, {});
    const Pose back = motion.inverse() * found.correction * motion * said;
    RC_ASSERT((back.position_m - plain.position_m).norm() < 0.002);
    RC_ASSERT(angle_between_rad(back, plain) < 0.02 * kDegree);
  }));
}

TEST_CASE("two references fix what one of them leaves open") {
  Scene corner;
  corner.add(Box{{Eigen::Quaterniond::Identity(), {6.0, 0.0, 0.0}}, Eigen::Vector3d(1.0, 30.0, 30.0)});
  Scene other = corner;
  other.add(Box{{Eigen::Quaterniond::Identity(), {0.0, 6.0, 0.0}}, Eigen::Vector3d(30.0, 1.0, 30.0)});
  other.add(Box{{Eigen::Quaterniond::Identity(), {0.0, 0.0, -4.0}}, Eigen::Vector3d(30.0, 30.0, 1.0)});
  const Taken scan = taken(other, from(0.5, 0.5), 1), bare = taken(corner, from(0.0, 0.0), 2),
              whole = taken(other, from(1.0, 0.0), 3);
  const Pose said = disturbed(scan.scan.true_world_from_sensor, kUsualError, 4);
  const std::vector<ScanView> both = {bare.at_true_pose(), whole.at_true_pose()};
  const Alignment found = align(scan.view(said), both, {});
  CHECK(found.free_directions == 0);
  CHECK(error_of(found, said, scan).position_m < 0.003);
}

TEST_CASE("a prior with a wrong pose is left out of a comparison, and one that stands elsewhere is put right") {
  const Taken &scan = taken(Family::lab, 4), &good = taken(Family::lab, 0), &wrong = taken(Family::lab, 1);
  const Pose far = shifted(good.scan.true_world_from_sensor, {0.2, 0.1, 0.0});
  const std::vector<ScanView> priors = {
      wrong.view(turned(wrong.scan.true_world_from_sensor, 1.0, Eigen::Vector3d::UnitZ())), good.view(far)};
  const AlignedPriors aligned_priors = align_priors(scan.at_true_pose(), priors, {});
  REQUIRE(aligned_priors.alignments.size() == 2);
  CHECK(aligned_priors.alignments[0].state == RegistrationState::bad);
  CHECK(aligned_priors.alignments[0].uncertainty.position_m > 2.0 * AlignParameters{}.reported.position_m);
  CHECK(aligned_priors.alignments[1].state == RegistrationState::moved);
  REQUIRE(aligned_priors.usable.size() == 1);
  CHECK((aligned_priors.usable[0].world_from_sensor.position_m - good.scan.true_world_from_sensor.position_m).norm() <
        0.003);
  CHECK(aligned_priors.usable[0].pose_uncertainty.position_m > 0.0);
  CHECK(aligned_priors.warnings.size() == 2);

  Comparison comparison;
  comparison.priors = {{.added = 7}};
  comparison.prior_points = {{.prior = 0, .index = 5}};
  restore_places(aligned_priors, comparison);
  REQUIRE(comparison.priors.size() == 2);
  CHECK(comparison.priors[0].added == 0);
  CHECK(comparison.priors[1].added == 7);
  CHECK(comparison.prior_points[0].prior == 1);
  CHECK(comparison.warnings.size() == 2);
}

TEST_CASE("when no prior fits, all are compared at their poses as reported, and the comparison says so") {
  const Taken &scan = taken(Family::lab, 4), &wrong = taken(Family::lab, 1);
  const Pose said = turned(wrong.scan.true_world_from_sensor, 1.0, Eigen::Vector3d::UnitZ());
  const ScanView prior = wrong.view(said);
  const AlignedPriors aligned_priors = align_priors(scan.at_true_pose(), {&prior, 1}, {});
  REQUIRE(aligned_priors.usable.size() == 1);
  CHECK(aligned_priors.usable[0].world_from_sensor.position_m == said.position_m);
  REQUIRE(aligned_priors.warnings.size() == 1);
  CHECK(aligned_priors.warnings[0].find("as reported") != std::string::npos);
}

TEST_CASE("a correction says the same of coordinates that have an origin") {
  const Pose correction = turned(from(0.1, 0.2), 0.01, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d origin_m(400'000.0, 5'000'000.0, 100.0), place_m(3.0, 4.0, 5.0);
  CHECK((with_origin(correction, origin_m) * (place_m + origin_m) - (correction * place_m + origin_m)).norm() < 1e-8);
}

}  // namespace
}  // namespace raywatch
