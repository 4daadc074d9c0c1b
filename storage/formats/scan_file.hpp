#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace raywatch {

/// The scan file formats that can be read.
enum class ScanFormat { pcd, ply, las, ptx, text, kitti };

/// The frame in which a file's points stand.
enum class Frame { sensor, world };

/// What is known about a scan file besides its bytes. `given` values come from a person (query, side-car, command line)
/// and win over what the file says; `fixed_pose` (of the sensor) is used only when neither says anything.
struct ScanHints {
  std::optional<ScanFormat> format;  ///< not given: decided from content and name
  std::optional<Frame> frame;        ///< not given: world for LAS, sensor for all else
  std::optional<Pose> pose;          ///< world_from_sensor
  std::optional<Time> captured_at;
  std::optional<std::string> sensor;
  std::optional<Pose> fixed_pose;
};

/// Limits that keep a hostile file from costing memory.
struct ScanFileLimits {
  std::uint64_t max_points = 50'000'000;
  std::uint64_t max_bytes = std::uint64_t{4} << 30;
};

/// One scan out of a file. The points are in the sensor frame, in the order of the file.
struct DecodedScan {
  PointCloud points;
  std::optional<Pose> world_from_sensor;
  std::optional<Time> captured_at;
  std::optional<std::string> sensor;
};

/// Reads every scan of a file (PTX can hold several, all others hold one).
///
/// Points in world coordinates are moved into the sensor frame in double precision before they become float.
/// An identity VIEWPOINT of a PCD file counts as absent. LAS gives no time: its GPS times need leap seconds to be UTC,
/// and the older ones do not even say of which week they are.
/// @throws UnsupportedFormat when the content is in none of the formats; InvalidInput when the file is empty or broken,
///   promises more points than it holds, has no finite point, or has world coordinates but no pose; TooLarge past a
///   limit; StorageError when it cannot be read. Every message names the place (line, byte, header field), but not the
///   file, which the caller knows.
std::vector<DecodedScan> read_scan_file(const std::filesystem::path& path, const ScanHints& hints = {},
                                        const ScanFileLimits& limits = {});

/// The format of a file: what its content shows, else its ending.
/// @throws UnsupportedFormat naming the known ones when neither tells; StorageError when it cannot be read.
ScanFormat scan_format_of(const std::filesystem::path& file);

/// "pcd", "ply", "las", "ptx", "text", "kitti"; also accepts the usual endings ("xyz", "csv", "txt", "asc", "bin").
/// @throws UnsupportedFormat naming the known ones.
ScanFormat parse_scan_format(std::string_view name);
std::string_view to_string(ScanFormat format);

/// @throws InvalidInput unless "sensor" or "world".
Frame parse_frame(std::string_view name);

}  // namespace raywatch
