#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/align.hpp"
#include "core/compare.hpp"
#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace raywatch {

/// Which files are compared, and how.
struct FileComparisonRequest {
  std::filesystem::path scan;
  std::vector<std::filesystem::path> priors;
  CompareParameters parameters;
};

/// A scan file in memory. The pose is relative to `FileComparison::origin_m`.
struct FileScan {
  PointCloud points;
  Pose world_from_sensor;
  std::optional<Time> captured_at;  ///< from the file or its side-car
};

/// How a prior was fitted onto the scan.
struct FileRegistration {
  Alignment alignment;   ///< its correction relative to `FileComparison::origin_m`
  PoseUncertainty size;  ///< of the correction
};

struct FileComparisonTimings {
  double read_ms = 0.0, index_ms = 0.0, align_ms = 0.0, detect_ms = 0.0, cluster_ms = 0.0;  ///< disjoint wall times
};

/// What came of comparing files. Places are relative to `origin_m`, so that they keep their precision in float.
struct FileComparison {
  FileScan scan;
  std::vector<FileScan> priors;                 ///< at their corrected poses
  std::vector<FileRegistration> registrations;  ///< one a prior; empty when poses were taken as they are
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  Comparison result;
  FileComparisonTimings timings;
};

/// Compares scan files without a store, through the same steps as the daemon. Runs in the caller's oneTBB arena.
///
/// A prior without a time is earlier than the scan; a scan without a time is later than its priors.
/// @throws InvalidInput when a file cannot be read, is broken, holds several scans, or nothing says from where it was
///   taken; UnsupportedFormat, TooLarge. The message names the file.
FileComparison compare_files(const FileComparisonRequest& request);

}  // namespace raywatch
