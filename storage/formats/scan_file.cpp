#include "storage/formats/scan_file.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "storage/formats/decode.hpp"
#include "storage/formats/file_bytes.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

std::vector<DecodedScan> decode_as(ScanFormat format, std::span<const std::byte> bytes, const ScanHints& hints,
                                   const ScanFileLimits& limits) {
  switch (format) {
    case ScanFormat::pcd:
      return decode_pcd(bytes, hints, limits);
    case ScanFormat::ply:
      return decode_ply(bytes, hints, limits);
    case ScanFormat::las:
      return decode_las(bytes, hints, limits);
    case ScanFormat::ptx:
      return decode_ptx(bytes, hints, limits);
    case ScanFormat::text:
      return decode_text(bytes, hints, limits);
    case ScanFormat::kitti:
      break;
  }
  return decode_kitti(bytes, hints, limits);
}

bool has_finite_point(const PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud[i].allFinite()) return true;
  }
  return false;
}

}  // namespace

std::vector<DecodedScan> decode_scan(std::span<const std::byte> bytes, std::string_view name, const ScanHints& hints,
                                     const ScanFileLimits& limits) {
  if (bytes.empty()) throw InvalidInput("the file is empty");
  const ScanFormat format = hints.format ? *hints.format : detect_scan_format(bytes, name);
  std::vector<DecodedScan> scans = decode_as(format, bytes, hints, limits);
  for (DecodedScan& scan : scans) {
    if (!has_finite_point(scan.points)) {
      throw InvalidInput("no finite point: none of the " + std::to_string(scan.points.size()) +
                         " points of the scan has three finite coordinates");
    }
    scan.captured_at = hints.captured_at;
    scan.sensor = hints.sensor;
  }
  return scans;
}

std::vector<DecodedScan> single_scan(PointCloud points, const std::optional<Pose>& world_from_sensor) {
  std::vector<DecodedScan> scans(1);
  scans.front().points = std::move(points);
  scans.front().world_from_sensor = world_from_sensor;
  return scans;
}

std::vector<DecodedScan> read_scan_file(const std::filesystem::path& path, const ScanHints& hints,
                                        const ScanFileLimits& limits) {
  const FileBytes file(path, limits.max_bytes);
  return decode_scan(file.bytes(), path.filename().string(), hints, limits);
}

Frame parse_frame(std::string_view name) {
  if (name == "sensor") return Frame::sensor;
  if (name == "world") return Frame::world;
  const std::string message = shown(name) + " is no frame; it is sensor or world";
  throw InvalidInput(message, {{"frame", message}});
}

}  // namespace raywatch
