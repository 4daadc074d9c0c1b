#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/file_comparison.hpp"

namespace raywatch {

/// Checks where results are to be written, before anything is read; an empty path is none.
/// @throws InvalidInput for an ending other than .csv, .pcd and .ply, a file that is one of the scans, however it is
///   spelled, or one that is given twice.
void check_outputs(const FileComparisonRequest& request, const std::vector<std::filesystem::path>& outputs);

/// A row for every point of the scan, in its order: x, y, z (world), class, free, supported, cluster.
/// @throws StorageError when the file cannot be written.
void write_classes(const std::filesystem::path& file, const FileComparison& comparison);

/// A row for every removed point of the priors: prior (its place among them, from 0), index (in that file), x, y, z
/// (world), cluster. In PCD and PLY the coordinates come first.
/// @throws StorageError when the file cannot be written.
void write_removed(const std::filesystem::path& file, const FileComparison& comparison);

/// The result as one JSON object. `write_ms` and `total_ms` are added to its timings.
std::string to_json(const FileComparisonRequest& request, const FileComparison& comparison, double write_ms,
                    double total_ms);

}  // namespace raywatch
