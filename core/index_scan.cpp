#include "core/index_scan.hpp"

#include <utility>

namespace raywatch {

ScanIndex index_scan(const PointCloud& points, const SensorModel& known, const CompareParameters& parameters) {
  UsableRange usable = usable_range(known, parameters);
  PriorIndex index = PriorIndex::build(points, usable);
  const SensorModel estimated = estimate_sensor(points, index);
  const UsableRange without_sentinel = usable_range(merged(known, estimated), parameters);
  if (without_sentinel.no_return_m != usable.no_return_m) {
    usable = without_sentinel;
    index = PriorIndex::build(points, usable);
  }
  return {std::move(index), estimated, usable};
}

}  // namespace raywatch
