// Registering the scans of a night on ground that stays: known errors are found again, with an honest uncertainty.

#include "core/stable_ground.hpp"

#include <doctest/doctest.h>

#include <memory>

#include "tests/simulator/pit.hpp"
#include "tests/simulator/random.hpp"
#include "tests/simulator/registration.hpp"
#include "tests/simulator/simulated_scan.hpp"

namespace raywatch {
namespace {

using namespace simulator;

constexpr double kNoise_m = 0.02;

struct Taken {
  SimulatedScan scan;
  PriorIndex index;

  ScanView view(const Pose& world_from_sensor) const {
    return {scan.points,
            index,
            world_from_sensor,
            scan.captured_at,
            {.range_noise_m = kNoise_m, .angular_resolution_rad = Eigen::Vector2d(radians(0.75), radians(0.25))}};
  }
};

Taken taken(const HeightField& ground, const Pose& from, std::uint64_t seed) {
  Scene scene;
  scene.add(Terrain{std::shared_ptr<const HeightField>(std::shared_ptr<void>(), &ground), nullptr});
  Scanner scanner;
  for (int i = 0; i < 240; ++i) scanner.azimuths_rad.push_back(radians(-90.0 + 0.75 * i));
  for (int i = 0; i < 180; ++i) scanner.elevations_rad.push_back(radians(-42.0 + 0.25 * i));
  scanner.max_range_m = 600.0;
  scanner.errors.range_noise_m = kNoise_m;
  SimulatedScan scan = take_scan(RayCaster(scene), scanner, exact_plan(from, seed));
  PriorIndex index = PriorIndex::build(scan.points, {});
  return {std::move(scan), std::move(index)};
}

Prism box(double x_from, double x_to, double y_from, double y_to, double z_from, double z_to) {
  return {{{x_from, y_from}, {x_to, y_from}, {x_to, y_to}, {x_from, y_to}}, z_from, z_to};
}

/// What no blast reaches: the upper benches with their faces, the floor, and the walls at both ends.
const std::vector<Prism> kStable{box(28.0, 118.0, -118.0, 118.0, 5.0, 60.0),
                                 box(-118.0, -28.0, -118.0, 118.0, -2.0, 30.0)};

/// A night of a pit after a blast, and the night before, which is the reference.
struct Nights {
  Pit pit{7};
  HeightField before = pit.ground(1), after = pit.ground(2);
  Pose from{.position_m = {-65.0, 10.0, 24.0}}, reference_from{.position_m = {-70.0, -20.0, 24.0}};
  Taken reference = taken(before, reference_from, 1);

  StableRegistration registered(const Taken& night, const Pose& said, std::span<const Prism> stable,
                                const StableParameters& parameters = {}) const {
    const ScanView view = night.view(said), against = reference.view(reference_from);
    return register_on(view, points_in(view, stable), {&against, 1}, parameters);
  }
};

TEST_CASE("known errors of a pose are found on stable ground, as well as the uncertainty says") {
  const Nights nights;
  constexpr int kSeeds = 6;
  Eigen::Array3d shifts2_m2 = Eigen::Array3d::Zero();
  double turns2 = 0.0, told2_m2 = 0.0, told2 = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Taken night = taken(nights.after, nights.from, 100 + seed);
    const Pose said = disturbed(nights.from, {.position_sigma_m = 0.05, .angle_sigma_rad = radians(0.05)}, seed);
    const StableRegistration found = nights.registered(night, said, kStable);
    CHECK_MESSAGE(!found.refused.has_value(), found.refused.value_or(""));
    const Pose corrected = found.alignment.correction * said;
    shifts2_m2 += (corrected.position_m - nights.from.position_m).array().square() / kSeeds;
    turns2 += std::pow(angle_between_rad(corrected, nights.from), 2.0) / 3.0 / kSeeds;
    told2_m2 += std::pow(found.alignment.uncertainty.position_m, 2.0) / kSeeds;
    told2 += std::pow(found.alignment.uncertainty.angle_rad, 2.0) / kSeeds;
    CHECK(found.alignment.residual_m < kNoise_m);
    CHECK(found.points > 10000);
  }
  // What is told is that of the axis which is known least; there normalised errors are near 1, and nowhere far above.
  CHECK(std::sqrt(shifts2_m2.maxCoeff() / told2_m2) == doctest::Approx(1.0).epsilon(0.5));
  CHECK(std::sqrt(turns2 / told2) < 1.2);
  CHECK(std::sqrt(turns2 / told2) > 0.2);
  CHECK(std::sqrt(shifts2_m2.sum()) < 0.005);
}

TEST_CASE("without control zones, what a first comparison finds unchanged is stable ground") {
  const Nights nights;
  const Taken night = taken(nights.after, nights.from, 200);
  Pose said = nights.from;
  said.position_m += Eigen::Vector3d(0.02, -0.02, 0.01);
  ScanView view = night.view(said);
  view.captured_at = Time(std::chrono::hours(24));
  const ScanView against = nights.reference.view(nights.reference_from);
  CompareParameters parameters;
  parameters.align = false;
  parameters.range_m = 0.3;
  const Comparison first = compare(view, {&against, 1}, parameters);
  const std::vector<std::uint32_t> stable = unchanged_points(first.classes);
  CHECK(stable.size() < first.classes.size());
  const StableRegistration found = register_on(view, stable, {&against, 1}, {});
  CHECK_MESSAGE(!found.refused.has_value(), found.refused.value_or(""));
  CHECK((found.alignment.correction * said.position_m - nights.from.position_m).norm() < 0.005);
}

TEST_CASE("what does not hold the scan, does not fit, or is out of tolerance is refused with the reason") {
  const Nights nights;
  const Taken night = taken(nights.after, nights.from, 300);
  const auto reason = [](const StableRegistration& found) { return found.refused.value_or(""); };
  const auto says = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };

  StableParameters strict;
  strict.tolerance.residual_m = 0.001;
  CHECK(says(reason(nights.registered(night, nights.from, kStable, strict)), "The residual on stable ground is"));
  strict = {};
  strict.tolerance.uncertainty.position_m = 0.0005;
  CHECK(says(reason(nights.registered(night, nights.from, kStable, strict)), "stays uncertain by"));
  const std::vector<Prism> nowhere{box(500.0, 510.0, 500.0, 510.0, 0.0, 1.0)};
  CHECK(says(reason(nights.registered(night, nights.from, nowhere)), "Only 0 of the scan's points"));
  // A scan that was turned by a degree does not fit, or fits too far away to be the error of a pose.
  const Pose turned{nights.from.orientation * Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ())),
                    nights.from.position_m};
  CHECK_FALSE(reason(nights.registered(night, turned, kStable)).empty());
}

TEST_CASE("a plane alone is refused: nothing keeps a scan from sliding on it") {
  const HeightField plane(FieldLayout{{-120.0, -120.0}, 4.0, 61, 61},
                          [](const Eigen::Vector2d& p) { return 0.02 * p.x(); });
  const Pose from{.position_m = {-65.0, 10.0, 24.0}}, reference_from{.position_m = {-70.0, -20.0, 24.0}};
  const Taken night = taken(plane, from, 1), reference = taken(plane, reference_from, 2);
  const ScanView view = night.view(from), against = reference.view(reference_from);
  const std::vector<Prism> floor{box(-60.0, 60.0, -80.0, 80.0, -5.0, 5.0)};
  const StableRegistration found = register_on(view, points_in(view, floor), {&against, 1}, {});
  CHECK(found.alignment.free_directions == 3);
  CHECK(found.refused.value_or("").find("leaves 3 of the six directions of motion free") != std::string::npos);
}

}  // namespace
}  // namespace raywatch
