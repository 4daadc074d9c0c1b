#include "tests/evaluate/indexed_place.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "core/align.hpp"
#include "core/error.hpp"
#include "core/profile.hpp"

namespace raywatch::evaluation {

IndexedPlace::IndexedPlace(const Place& place, Profile profile) : place_(&place), scans_(place.scans.size()) {
  tbb::parallel_for(std::size_t{0}, scans_.size(), [&](std::size_t i) { scans_[i] = index(place.scans[i], profile); });
  for (const IndexedScan& scan : scans_) {
    const SensorModel& sensor = scan.published->estimated;
    if (!sensor.angular_resolution_rad) continue;
    spacing_rad_ = std::max(spacing_rad_, sensor.angular_resolution_rad->maxCoeff());
  }
  if (spacing_rad_ == 0.0) {
    throw InvalidInput(place.name + ": no scan has enough returns to tell the spacing of its shots");
  }
}

IndexedPlace::IndexedScan IndexedPlace::index(const SimulatedScan& scan, Profile profile) {
  const CompareParameters published{.grouping = Grouping::union_};
  const auto indexed = [&](const CompareParameters& parameters) {
    return std::make_shared<const ScanIndex>(index_scan(scan.points, {}, parameters));
  };
  return {indexed(published), indexed(default_parameters(profile, Grouping::consensus))};
}

ScanView IndexedPlace::view(std::size_t scan, Grouping grouping) const {
  const SimulatedScan& taken = place_->scans[scan];
  const ScanIndex& as = grouping == Grouping::union_ ? *scans_[scan].published : *scans_[scan].weighed;
  return {taken.points, as.index, taken.reported_world_from_sensor, taken.captured_at, as.estimated};
}

CaseViews IndexedPlace::views(const Case& c, Grouping grouping) const {
  CaseViews views{view(c.scan, grouping), {}};
  for (const std::size_t prior : c.priors) views.priors.push_back(view(prior, grouping));
  return views;
}

CaseViews IndexedPlace::refined_views(const Case& c, const CompareParameters& parameters) const {
  CaseViews refined = views(c, parameters.grouping);
  if (!refines_poses(parameters)) return refined;
  for (ScanView& prior : refined.priors) {
    const Alignment alignment = align(prior, {&refined.scan, 1}, {});
    prior.world_from_sensor = alignment.correction * prior.world_from_sensor;
    prior.pose_uncertainty = alignment.uncertainty;
  }
  return refined;
}

}  // namespace raywatch::evaluation
