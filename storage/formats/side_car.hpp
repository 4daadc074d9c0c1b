#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string_view>

#include "storage/formats/scan_file.hpp"

namespace raywatch {

/// @{ What to write into a side-car, for messages that miss it.
inline constexpr const char* kPoseInSideCar =
    R"({"pose": {"position_m": [x, y, z], "orientation_xyzw": [x, y, z, w]}})";
inline constexpr const char* kTimeInSideCar = R"({"captured_at": "2026-03-01T02:10:00Z"})";
/// @}

/// Reads `FILE.json` beside a scan file:
/// `{"captured_at": "...", "sensor": "...", "frame": "sensor"|"world", "pose": {"position_m": [x,y,z],
/// "orientation_xyzw": [x,y,z,w]}}`; every member may be absent.
/// @returns empty hints when there is no such file.
/// @throws InvalidInput for malformed JSON, an unknown member, a wrong type or a bad value, naming file and member.
ScanHints read_side_car(const std::filesystem::path& scan_file);

/// The same from JSON text; `name` stands in error messages.
ScanHints parse_side_car(std::string_view json, std::string_view name);

/// Writes `scan_file` + ".json" with whatever `hints` holds.
void write_side_car(const std::filesystem::path& scan_file, const ScanHints& hints);

/// "x,y,z,qx,qy,qz,qw" (world_from_sensor, metres and unit quaternion), as in the query of an upload.
/// @throws InvalidInput naming `field` when it is not seven finite numbers with a unit quaternion.
Pose parse_pose_text(std::string_view text, const char* field);

}  // namespace raywatch
