// Scans that come to a daemon: which are aligned, against what, and what becomes of those that do not fit.

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "core/panorama.hpp"
#include "core/profile.hpp"
#include "server/comparison_runner.hpp"
#include "storage/payloads.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"
#include "tests/simulator/family.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {
namespace {

using namespace simulator;

constexpr double kDegree = std::numbers::pi / 180.0;

/// The lab's scans, made once: pose k of time t is scan 3 t + k.
const SimulatedScan& lab_scan(std::size_t number) {
  static const FamilyOptions options{.seed = 3, .density = 0.2};
  static const Timeline timeline = make_timeline(Family::lab, options);
  static std::map<std::size_t, SimulatedScan> scans;
  if (!scans.contains(number)) scans.emplace(number, take_scan(timeline, timeline.moments.at(number)));
  return scans.at(number);
}

Pose turned(Pose pose, double angle_rad, const Eigen::Vector3d& axis) {
  pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis)) * pose.orientation;
  return pose;
}

Pose shifted(Pose pose, const Eigen::Vector3d& by_m) {
  pose.position_m += by_m;
  return pose;
}

/// A store with the site "lab", and a runner that carries out its comparisons one after the other.
class Place {
 public:
  explicit Place(const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero()) : origin_m_(origin_m) {
    store_.write([&](Transaction& transaction) {
      site_ = insert_site(transaction, {.name = "lab", .time_zone = "UTC"}, now()).id;
    });
  }

  SensorId add_sensor(const std::string& name, const std::optional<Pose>& fixed_pose = {}) {
    return store_.write([&](Transaction& transaction) {
      return insert_sensor(transaction, {.name = name, .site = site_, .pose = fixed_pose}, now()).id;
    });
  }

  /// Stores a scan with the pose that it is said to have, compares it with `previous`, and gives it back.
  ScanRecord take(SensorId sensor, const SimulatedScan& scan, const Pose& said) {
    ScanRecord record{.site = site_, .sensor = sensor, .captured_at = now(), .received_at = now()};
    record.pose = shifted(said, origin_m_);
    record.points = scan.points.size();
    record.sha256 = std::to_string(++number_);
    record.estimated = estimate_sensor(scan.points);
    record.payload =
        store_.payloads().put_scan(site_, record.captured_at, scan.points, make_panorama(scan.points, UsableRange{}));
    const ScanId id = store_.write([&](Transaction& transaction) { return insert_scan(transaction, record).id; });
    compare(id, PreviousReference{}, default_parameters(Profile::indoor, Grouping::consensus));
    return store_.read([&](const Snapshot& snapshot) { return *find_scan(snapshot, id); });
  }

  ComparisonRecord compare(ScanId scan, const Reference& reference, const CompareParameters& parameters) {
    const ComparisonId id = store_.write([&](Transaction& transaction) {
      return insert_comparison(transaction, scan, reference, parameters, now()).id;
    });
    const auto job = store_.write([&](Transaction& transaction) { return start_job(transaction, site_); });
    runner_.run(job.value(), arena_);
    return comparison(id);
  }

  ComparisonRecord comparison(ComparisonId id) {
    return store_.read([&](const Snapshot& snapshot) { return *find_comparison(snapshot, id); });
  }
  ComparisonRecord comparison_of(const ScanRecord& scan) {
    return store_.read([&](const Snapshot& snapshot) { return comparisons_of(snapshot, scan.id).front(); });
  }
  std::vector<ComparisonCandidate> candidates_of(const ScanRecord& scan) {
    return store_.read([&](const Snapshot& snapshot) {
      return raywatch::candidates_of(snapshot, comparisons_of(snapshot, scan.id).front().id);
    });
  }

 private:
  Time now() const { return parse_rfc3339("2026-03-01T08:00:00Z") + std::chrono::minutes(number_); }

  TempDir folder_;
  Eigen::Vector3d origin_m_;
  Store store_{{.data_dir = folder_.path()}};
  IndexCache cache_{1 << 30};
  ProgressBoard progress_;
  ComparisonRunner runner_{
      store_, cache_, progress_, {.previous_limit = std::chrono::hours(24)}, [this] { return now(); }};
  tbb::task_arena arena_{2};
  SiteId site_;
  int number_ = 0;
};

bool has_warning(const ComparisonRecord& comparison, const std::string& text) {
  return std::ranges::any_of(comparison.warnings,
                             [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

TEST_CASE(
    "the first scan of a place is the anchor, and later ones are put right against it, never against each other") {
  Place place;
  const SensorId sensor = place.add_sensor("rover");
  const Pose error = turned({Eigen::Quaterniond::Identity(), {0.01, -0.02, 0.015}}, 0.1 * kDegree, {0.0, 0.0, 1.0});
  const ScanRecord anchor = place.take(sensor, lab_scan(0), lab_scan(0).true_world_from_sensor);
  CHECK(anchor.registration.state == RegistrationState::none);
  REQUIRE(anchor.registration.uncertainty);
  CHECK(anchor.registration.uncertainty->position_m == 0.0);
  for (const std::size_t number : {3, 4, 6}) {
    const Pose truth = lab_scan(number).true_world_from_sensor, said = error * truth;
    const ScanRecord scan = place.take(sensor, lab_scan(number), said);
    CHECK(scan.registration.state == RegistrationState::good);
    CHECK(scan.registration.against == anchor.id);
    CHECK(scan.pose.position_m == said.position_m);
    const Pose corrected = scan.registration.correction * scan.pose;
    CHECK((corrected.position_m - truth.position_m).norm() < 0.004);
    CHECK(angle_between_rad(corrected, truth) < 0.03 * kDegree);
    CHECK(scan.registration.residual_m.value() < 0.02);
    CHECK(scan.registration.inliers.value() > 0.8);
    CHECK(scan.registration.uncertainty.value().position_m > 0.0);
    CHECK(place.comparison_of(scan).timings_ms.contains("align"));
  }
}

TEST_CASE("in map coordinates the same corrected poses come out") {
  const Eigen::Vector3d origin_m(401'000.0, 5'502'000.0, 120.0);
  Place place(origin_m);
  const SensorId sensor = place.add_sensor("rover");
  place.take(sensor, lab_scan(0), lab_scan(0).true_world_from_sensor);
  const Pose truth = lab_scan(3).true_world_from_sensor;
  const ScanRecord scan =
      place.take(sensor, lab_scan(3), turned(shifted(truth, {0.02, 0.0, 0.01}), 0.1 * kDegree, {0.0, 1.0, 0.0}));
  CHECK(scan.registration.state == RegistrationState::good);
  CHECK((scan.registration.correction * scan.pose).position_m.isApprox(truth.position_m + origin_m, 1e-9));
}

TEST_CASE("a scan that does not fit is marked, says so, and is never chosen as an earlier scan") {
  Place place;
  const SensorId sensor = place.add_sensor("rover");
  const ScanRecord anchor = place.take(sensor, lab_scan(0), lab_scan(0).true_world_from_sensor);
  const Pose wrong = turned(lab_scan(3).true_world_from_sensor, 1.0, {0.0, 0.0, 1.0});
  const ScanRecord bad = place.take(sensor, lab_scan(3), wrong);
  CHECK(bad.registration.state == RegistrationState::bad);
  CHECK(bad.registration.correction.position_m.isZero());
  CHECK(has_warning(place.comparison_of(bad), "does not fit"));

  const ScanRecord next = place.take(sensor, lab_scan(6), lab_scan(6).true_world_from_sensor);
  CHECK(next.registration.state == RegistrationState::good);
  const ComparisonRecord compared = place.comparison_of(next);
  REQUIRE(compared.priors.size() == 1);
  CHECK(compared.priors[0].scan == anchor.id);
  const std::vector<ComparisonCandidate> candidates = place.candidates_of(next);
  const auto refused = std::ranges::find(candidates, bad.id, &ComparisonCandidate::scan);
  REQUIRE(refused != candidates.end());
  CHECK_FALSE(refused->chosen);
  CHECK(refused->reason.find("registration is bad") != std::string::npos);
}

TEST_CASE("a scan that is asked for is used though it does not fit, and the comparison says so") {
  Place place;
  const SensorId sensor = place.add_sensor("rover");
  place.take(sensor, lab_scan(0), lab_scan(0).true_world_from_sensor);
  const ScanRecord bad =
      place.take(sensor, lab_scan(3), turned(lab_scan(3).true_world_from_sensor, 1.0, {0.0, 0.0, 1.0}));
  const ScanRecord scan = place.take(sensor, lab_scan(6), lab_scan(6).true_world_from_sensor);
  REQUIRE(bad.registration.state == RegistrationState::bad);
  const ComparisonRecord compared =
      place.compare(scan.id, ExplicitReference{{bad.id}}, default_parameters(Profile::indoor, Grouping::consensus));
  REQUIRE(compared.priors.size() == 1);
  CHECK(compared.priors[0].scan == bad.id);
  CHECK(compared.testable > 0.0);
  CHECK(has_warning(compared, "Scan " + std::to_string(bad.id.value) + " does not fit onto the earlier ones"));
}

TEST_CASE("of a scan that is asked for and cannot be used, the comparison says why") {
  Place place;
  const SensorId sensor = place.add_sensor("rover");
  const ScanRecord far = place.take(sensor, lab_scan(0), shifted(lab_scan(0).true_world_from_sensor, {1e4, 0.0, 0.0}));
  const ScanRecord scan = place.take(sensor, lab_scan(3), lab_scan(3).true_world_from_sensor);
  const ComparisonRecord compared =
      place.compare(scan.id, ExplicitReference{{far.id}}, default_parameters(Profile::indoor, Grouping::consensus));
  CHECK(compared.priors.empty());
  CHECK(has_warning(compared,
                    "Scan " + std::to_string(far.id.value) + " was asked for and is not used: too little overlap"));
}

TEST_CASE("a fixed sensor that was tilted is good with a warning at first, and moved when it stays so") {
  Place place;
  const Pose fixed = lab_scan(0).true_world_from_sensor;
  const SensorId sensor = place.add_sensor("mast", fixed);
  place.take(sensor, lab_scan(0), fixed);
  CHECK(place.take(sensor, lab_scan(3), fixed).registration.state == RegistrationState::good);

  // The sensor was tilted, and goes on saying that it stands as before.
  const Pose said = turned(fixed, -0.006, {1.0, 0.0, 0.0});
  const ScanRecord first = place.take(sensor, lab_scan(6), said), second = place.take(sensor, lab_scan(9), said);
  CHECK(first.registration.state == RegistrationState::good);
  CHECK(has_warning(place.comparison_of(first), "more than its fixed sensor may be off"));
  CHECK(second.registration.state == RegistrationState::moved);
  CHECK(has_warning(place.comparison_of(second), "was moved or has tilted"));
  CHECK(angle_between_rad(second.registration.correction, Pose{}) == doctest::Approx(0.006).epsilon(0.1));
}

TEST_CASE("a comparison can take all poses as they were reported") {
  Place place;
  const SensorId sensor = place.add_sensor("rover");
  const ScanRecord anchor = place.take(sensor, lab_scan(0), lab_scan(0).true_world_from_sensor);
  const Pose far = shifted(lab_scan(3).true_world_from_sensor, {0.14, 0.0, 0.0});
  const ScanRecord scan = place.take(sensor, lab_scan(3), far);
  REQUIRE(scan.registration.state == RegistrationState::good);
  CompareParameters as_reported = default_parameters(Profile::indoor, Grouping::consensus);
  as_reported.align = false;
  const ComparisonRecord plain = place.compare(scan.id, ExplicitReference{{anchor.id}}, as_reported);
  CHECK(plain.changes > place.comparison_of(scan).changes);
}

}  // namespace
}  // namespace raywatch
