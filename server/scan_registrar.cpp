#include "server/scan_registrar.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "core/panorama.hpp"
#include "server/reference_resolver.hpp"
#include "storage/payloads.hpp"
#include "storage/sensors.hpp"

namespace raywatch {
namespace {

std::string warning_of_moved(const PoseUncertainty& size, const char* meaning) {
  char text[200];
  std::snprintf(text, sizeof text,
                "The scan fits onto the earlier ones only when it is moved by %.3g m and turned by %.3g degrees: %s.",
                size.position_m, size.angle_rad * 180.0 / std::numbers::pi, meaning);
  return text;
}

bool exceeds(const PoseUncertainty& size, const PoseUncertainty& tolerance) {
  return size.position_m > tolerance.position_m || size.angle_rad > tolerance.angle_rad;
}

/// How far apart two corrections put the same sensor.
PoseUncertainty difference(const Pose& a, const Pose& b, const Pose& reported) {
  const Pose one = a * reported, other = b * reported;
  return {(one.position_m - other.position_m).norm(), angle_between_rad(one, other)};
}

}  // namespace

std::vector<std::string> registration_warnings(const ScanRecord& scan) {
  switch (scan.registration.state) {
    case RegistrationState::bad:
      return {
          "The scan does not fit onto the earlier ones: its pose is wrong, or nearly everything changed. It is "
          "compared "
          "at the pose as reported, and later scans are not compared with it."};
    case RegistrationState::moved:
      return {warning_of_moved(size_of(scan.registration.correction, scan.pose), "its sensor was moved or has tilted")};
    case RegistrationState::none:
    case RegistrationState::good:
      break;
  }
  return {};
}

std::vector<ScanRecord> ScanRegistrar::anchors_of(const ScanRecord& scan, const Site& site, const LoadedScan& loaded,
                                                  tbb::task_arena& arena) const {
  const double radius_m = 2.0 * reach_m(*loader_.panorama(scan));
  const std::vector<ScanRecord> offered = store_.read([&](const Snapshot& snapshot) {
    std::vector<ScanRecord> anchors;
    const Eigen::Vector3d& position_m = loaded.world_from_sensor.position_m;
    for (const Vantage& vantage : nearest_vantages(snapshot, site.id, position_m, kMaxVantages)) {
      if ((vantage.position_m - position_m).norm() > radius_m) break;
      std::optional<ScanRecord> anchor = find_anchor(snapshot, vantage.id);
      if (anchor && anchor->id != scan.id) anchors.push_back(std::move(*anchor));
    }
    return anchors;
  });
  std::vector<PriorCandidate> candidates;
  for (const ScanRecord& anchor : offered) {
    candidates.push_back({.world_from_sensor = reported_local_pose(anchor, site),
                          .captured_at = anchor.captured_at,
                          .coverage = loader_.panorama(anchor)});
  }
  const ChoiceParameters choice{.max_priors = config_.max_anchors};
  const std::vector<Eigen::Vector3d> sample_m = sample_world_points(
      loaded.indexed->points, loaded.world_from_sensor, loaded.indexed->index.usable(), choice.sample_points);
  const std::vector<CandidateAssessment> assessments = arena.execute(
      [&] { return choose_priors(sample_m, loaded.world_from_sensor, scan.captured_at, candidates, choice); });
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < offered.size(); ++i) {
    if (assessments[i].chosen) chosen.push_back(i);
  }
  std::ranges::stable_sort(chosen, std::ranges::greater{}, [&](std::size_t i) { return assessments[i].overlap; });
  std::vector<ScanRecord> anchors;
  for (const std::size_t i : chosen) anchors.push_back(offered[i]);
  return anchors;
}

ScanRegistration ScanRegistrar::operator()(const ScanRecord& scan, const Site& site,
                                           const CompareParameters& parameters, const LoadedScan& loaded,
                                           tbb::task_arena& arena) const {
  const std::vector<ScanRecord> anchors = anchors_of(scan, site, loaded, arena);
  if (anchors.empty()) return {.registration = {.uncertainty = PoseUncertainty{}}, .warnings = {}};
  std::vector<LoadedScan> references;
  for (const ScanRecord& anchor : anchors) references.push_back(loader_.load(anchor, site, parameters, arena));
  std::vector<ScanView> views;
  for (const LoadedScan& reference : references) views.push_back(reference.view());

  const std::optional<Sensor> sensor =
      store_.read([&](const Snapshot& snapshot) { return find_sensor(snapshot, scan.sensor); });
  const bool is_fixed = sensor && sensor->pose;
  Alignment found = arena.execute([&] { return align(loaded.view(), views, config_.align); });
  // Where the anchors of other places leave directions open, the place needs an anchor of its own.
  const bool has_own_anchor =
      std::ranges::any_of(anchors, [&](const ScanRecord& anchor) { return anchor.vantage == scan.vantage; });
  if (found.state != RegistrationState::bad && found.free_directions > 0 && !has_own_anchor) {
    found = {.uncertainty = config_.align.reported};
  }
  ScanRegistration result = judged(scan, site, found, is_fixed);
  if (result.registration.state != RegistrationState::none) result.registration.against = anchors.front().id;
  return result;
}

ScanRegistration ScanRegistrar::judged(const ScanRecord& scan, const Site& site, const Alignment& found,
                                       bool is_fixed) const {
  ScanRegistration result;
  Registration& registration = result.registration;
  registration.state = found.state;
  registration.uncertainty = found.uncertainty;
  if (found.state == RegistrationState::none) return result;
  registration.correction = with_origin(found.correction, site.origin_m.value_or(Eigen::Vector3d::Zero()));
  registration.residual_m = found.residual_m;
  registration.inliers = found.inliers;
  const PoseUncertainty size = size_of(registration.correction, scan.pose);
  if (is_fixed && found.state != RegistrationState::bad && exceeds(size, config_.fixed_tolerance)) {
    // A mast that sways is not moved: what was moved stays where it is.
    const std::optional<ScanRecord> last = store_.read(
        [&](const Snapshot& snapshot) { return latest_registered(snapshot, scan.sensor, scan.captured_at); });
    const bool lasts = last && !exceeds(difference(last->registration.correction, registration.correction, scan.pose),
                                        config_.fixed_tolerance);
    registration.state = lasts ? RegistrationState::moved : RegistrationState::good;
    if (!lasts) result.warnings = {warning_of_moved(size, "more than its fixed sensor may be off")};
  }
  return result;
}

}  // namespace raywatch
