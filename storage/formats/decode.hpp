#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "storage/formats/scan_file.hpp"

namespace raywatch {

/// `read_scan_file` without a file: `name` is its name, which only decides the format when the content does not.
std::vector<DecodedScan> decode_scan(std::span<const std::byte> bytes, std::string_view name, const ScanHints& hints,
                                     const ScanFileLimits& limits);

/// What the content shows, else what the name says.
/// @throws UnsupportedFormat naming the known formats when neither tells.
ScanFormat detect_scan_format(std::span<const std::byte> bytes, std::string_view name);

/// @{ The readers, one a format. They throw as `read_scan_file` does; that a scan has a finite point is checked after
/// them.
std::vector<DecodedScan> decode_pcd(std::span<const std::byte> bytes, const ScanHints&, const ScanFileLimits&);
std::vector<DecodedScan> decode_ply(std::span<const std::byte> bytes, const ScanHints&, const ScanFileLimits&);
std::vector<DecodedScan> decode_las(std::span<const std::byte> bytes, const ScanHints&, const ScanFileLimits&);
std::vector<DecodedScan> decode_ptx(std::span<const std::byte> bytes, const ScanHints&, const ScanFileLimits&);
std::vector<DecodedScan> decode_text(std::span<const std::byte> bytes, const ScanHints&, const ScanFileLimits&);
std::vector<DecodedScan> decode_kitti(std::span<const std::byte> bytes, const ScanHints&, const ScanFileLimits&);
/// @}

/// The one scan of a file.
std::vector<DecodedScan> single_scan(PointCloud points, const std::optional<Pose>& world_from_sensor);

/// The bytes as text.
inline std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace raywatch
