#pragma once

#include "core/epoch_scans.hpp"
#include "core/volume.hpp"

namespace raywatch {

/// Two epochs, the earlier first. Their scans must be registered to each other.
struct EpochPair {
  const EpochScans& before;
  const EpochScans& after;
};

/// What is said of the points of one scan.
struct EpochPoints {
  std::vector<PointClass> classes;      ///< one a point: of the earlier epoch removed, of the later one added
  std::vector<std::int32_t> change_of;  ///< one a point: its place in `EpochComparison::changes` or -1
};

/// The result of comparing two epochs as a whole.
struct EpochComparison {
  std::vector<EpochPoints> before, after;  ///< one a scan
  std::vector<Change> changes;             ///< of both epochs' points; ordered as those of `Comparison`
  double testable_before = 0.0;  ///< share of the points of the epoch about which a scan of the other can tell
  double testable_after = 0.0;
  std::vector<std::string> warnings;
};

/// Compares every scan of each epoch with all scans of the other that overlap it, both ways: a point of the later epoch
/// is added when those of the earlier one together say so, and a point of the earlier one removed when those of the
/// later one do (`detect`, with its consensus). So what one station could not see another may. Points of all scans
/// cluster together, so that one change is one change from however many stations it was seen; the volume of a `Change`
/// is that of its box.
///
/// Deterministic; in the caller's oneTBB arena. Clustering is always on.
/// @throws InvalidInput when an epoch is empty or the epochs are not apart in time by more than the contemporary
///   tolerance, or as `detect` does.
EpochComparison compare_epochs(const EpochPair& epochs, const CompareParameters& parameters);

/// Of each change the volume between the grounds of both epochs over its footprint: the cells that hold its points.
std::vector<FootprintVolume> volumes_of_changes(const EpochPair& epochs, const EpochComparison& comparison,
                                                const ElevationModel& before, const ElevationModel& after);

}  // namespace raywatch
