#include "storage/place_sights.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "core/look.hpp"
#include "core/profile.hpp"
#include "core/zone.hpp"

namespace raywatch {
namespace {

constexpr std::size_t kPlacesInBox = 27;

Presence presence_in(const Payloads& payloads, const ScanRecord& scan, const Pose& sensor_from_local,
                     const SensorModel& sensor, const CompareParameters& parameters, const PlaceQuestion& question) {
  const Thresholds thresholds = look_thresholds(sensor, parameters);
  const Eigen::Vector3d center_m = sensor_from_local * question.center_m;
  const double distance_m = center_m.norm();
  if (!(distance_m > 0.0)) return Presence::not_seen;
  const double ball_rad = distance_m > question.radius_m ? std::asin(question.radius_m / distance_m) : std::numbers::pi;
  const double cone_rad = std::min(std::numbers::pi, ball_rad + thresholds.angle_rad);
  const std::vector<PointCloud> returns = payloads.scan_points_around(scan.payload, {center_m, cone_rad});
  std::vector<Answer> answers;
  for (const Eigen::Vector3d& place_m : question.places_m) {
    answers.push_back(ask_returns(returns, usable_range(sensor, parameters), sensor_from_local * place_m, thresholds));
  }
  return presence_of(answers);
}

}  // namespace

PlaceQuestion question_at(const Eigen::Vector3d& place_m) { return {{place_m}, place_m, 0.0}; }

PlaceQuestion question_in(const Eigen::AlignedBox3d& box_m) {
  const Eigen::Vector3d low = box_m.min(), high = box_m.max();
  const Prism prism{
      {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}, low.z(), high.z()};
  return {lattice_places(prism, kPlacesInBox), box_m.center(), 0.5 * box_m.diagonal().norm()};
}

std::vector<PlaceSight> sights_of(const Payloads& payloads, const Site& site, std::span<const ScanRecord> scans,
                                  const std::map<SensorId, SensorModel>& known, const PlaceQuestion& question) {
  const CompareParameters parameters = default_parameters(site.profile, Grouping::consensus);
  std::vector<PlaceSight> sights(scans.size());
  tbb::parallel_for(std::size_t{0}, scans.size(), [&](std::size_t k) {
    const ScanRecord& scan = scans[k];
    const SensorModel sensor = merged(known.at(scan.sensor), scan.estimated);
    sights[k] = {scan.id, scan.captured_at,
                 presence_in(payloads, scan, local_pose(scan, site).inverse(), sensor, parameters, question)};
  });
  return sights;
}

}  // namespace raywatch
