#include "server/scan_loader.hpp"

#include <utility>

#include "core/align.hpp"
#include "core/error.hpp"
#include "storage/payloads.hpp"
#include "storage/sensors.hpp"

namespace raywatch {

void LoadedScan::place(const ScanRecord& scan, const Site& site, bool refined) {
  world_from_sensor = refined ? local_pose(scan, site) : reported_local_pose(scan, site);
  pose_uncertainty = refined ? scan.registration.uncertainty.value_or(AlignParameters{}.reported) : PoseUncertainty{};
}

LoadedScan ScanLoader::load(const ScanRecord& scan, const Site& site, const CompareParameters& parameters,
                            tbb::task_arena& arena) const {
  const std::optional<Sensor> sensor =
      store_.read([&](const Snapshot& snapshot) { return find_sensor(snapshot, scan.sensor); });
  if (!sensor) throw NotFound("the sensor of the scan does not exist any more");
  const SensorModel model = merged(sensor->known, scan.estimated);
  const UsableRange usable = usable_range(model, parameters);
  const auto build = [&]() -> IndexedScan {
    PointCloud points = store_.payloads().scan_points(scan.payload);
    PriorIndex index = arena.execute([&] { return PriorIndex::build(points, usable); });
    return {std::move(points), std::move(index)};
  };
  LoadedScan loaded{.indexed = cache_.get({scan.id, usable}, build),
                    .world_from_sensor = {},
                    .captured_at = scan.captured_at,
                    .sensor = model,
                    .pose_uncertainty = {}};
  loaded.place(scan, site, refines_poses(parameters));
  return loaded;
}

}  // namespace raywatch
