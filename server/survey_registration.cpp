#include "server/survey_registration.hpp"

#include "core/epoch.hpp"
#include "core/stable_ground.hpp"

namespace raywatch {
namespace {

/// Of each later scan the places of the points on stable ground.
std::vector<std::vector<std::uint32_t>> stable_points(const LoadedEpoch& after, const LoadedEpoch& before,
                                                      const StableGround& ground) {
  std::vector<std::vector<std::uint32_t>> stable;
  if (!ground.control.empty()) {
    for (const ScanView& scan : after.epoch.scans) stable.push_back(points_in(scan, ground.control));
    return stable;
  }
  const EpochComparison first = compare_epochs({before.epoch, after.epoch}, ground.parameters);
  for (const EpochPoints& scan : first.after) stable.push_back(unchanged_points(scan.classes));
  return stable;
}

void place(LoadedEpoch& epoch, std::size_t scan, const Alignment& alignment) {
  ScanView& view = epoch.epoch.scans[scan];
  view.world_from_sensor = alignment.correction * view.world_from_sensor;
  view.pose_uncertainty = alignment.uncertainty;
  SurveyedScan& about = epoch.about[scan];
  about.world_from_sensor = view.world_from_sensor;
  about.registration = alignment.state;
  about.residual_m = alignment.residual_m;
  about.uncertainty = alignment.uncertainty;
}

}  // namespace

std::optional<std::string> register_epoch(LoadedEpoch& after, const LoadedEpoch& before, const StableGround& ground,
                                          tbb::task_arena& arena) {
  return arena.execute([&]() -> std::optional<std::string> {
    const std::vector<std::vector<std::uint32_t>> stable = stable_points(after, before, ground);
    for (std::size_t k = 0; k < after.epoch.scans.size(); ++k) {
      const StableRegistration found = register_on(after.epoch.scans[k], stable[k], before.epoch.scans,
                                                   {.align = {}, .tolerance = ground.tolerance});
      if (found.refused) return "Scan " + std::to_string(after.about[k].scan.value) + ": " + *found.refused;
      place(after, k, found.alignment);
    }
    return std::nullopt;
  });
}

}  // namespace raywatch
