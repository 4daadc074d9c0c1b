#include "tests/evaluate/indexed_place.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "core/align.hpp"
#include "core/error.hpp"
#include "core/profile.hpp"
#include "core/sensor.hpp"

namespace raywatch::evaluation {

IndexedPlace::IndexedPlace(const Place& place, Profile profile) : place_(&place), scans_(place.scans.size()) {
  tbb::parallel_for(std::size_t{0}, scans_.size(), [&](std::size_t i) { scans_[i] = index(place.scans[i], profile); });
  for (const IndexedScan& scan : scans_) {
    if (!scan.sensor.angular_resolution_rad) continue;
    spacing_rad_ = std::max(spacing_rad_, scan.sensor.angular_resolution_rad->maxCoeff());
  }
  if (spacing_rad_ == 0.0) {
    throw InvalidInput(place.name + ": no scan has enough returns to tell the spacing of its shots");
  }
}

IndexedPlace::IndexedScan IndexedPlace::index(const SimulatedScan& scan, Profile profile) {
  IndexedScan indexed;
  const CompareParameters published{.grouping = Grouping::union_};
  const CompareParameters weighed = default_parameters(profile, Grouping::consensus);
  indexed.all = std::make_shared<PriorIndex>(PriorIndex::build(scan.points, usable_range({}, published)));
  indexed.sensor = estimate_sensor(scan.points, *indexed.all);
  indexed.usable = indexed.all;
  const UsableRange usable = usable_range(indexed.sensor, weighed);
  if (usable.no_return_m || usable.min_m > 0.0) {
    indexed.usable = std::make_shared<PriorIndex>(PriorIndex::build(scan.points, usable));
  }
  return indexed;
}

ScanView IndexedPlace::view(std::size_t scan, Grouping grouping) const {
  const SimulatedScan& taken = place_->scans[scan];
  const IndexedScan& indexed = scans_[scan];
  const PriorIndex& index = grouping == Grouping::union_ ? *indexed.all : *indexed.usable;
  return {taken.points, index, taken.reported_world_from_sensor, taken.captured_at, indexed.sensor};
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
