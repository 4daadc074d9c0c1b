#include <algorithm>
#include <array>
#include <string>

#include "core/error.hpp"
#include "storage/formats/decode.hpp"
#include "storage/formats/numbers.hpp"
#include "storage/formats/records.hpp"

namespace raywatch {
namespace {

using Bytes = std::span<const std::byte>;

/// Where the header says it, in bytes from its beginning (LAS 1.4 R15, table 3; the older headers are its beginning).
namespace at {
constexpr std::size_t kVersionMajor = 24;
constexpr std::size_t kVersionMinor = 25;
constexpr std::size_t kHeaderBytes = 94;
constexpr std::size_t kPointsOffset = 96;
constexpr std::size_t kPointFormat = 104;
constexpr std::size_t kRecordBytes = 105;
constexpr std::size_t kLegacyPoints = 107;
constexpr std::size_t kScale = 131;
constexpr std::size_t kOrigin = 155;
constexpr std::size_t kPoints = 247;  // from version 1.4 on
}  // namespace at

constexpr std::size_t kSmallestHeader = 227;
constexpr std::array<std::uint16_t, 5> kHeaderBytesOfMinor = {227, 227, 227, 235, 375};
constexpr std::array<std::uint16_t, 11> kRecordBytesOfFormat = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

struct LasHeader {
  std::uint64_t points = 0;
  std::size_t points_offset = 0;
  std::size_t record_bytes = 0;
  Eigen::Array3d scale_m, origin_m;
};

[[noreturn]] void refuse(const std::string& message) { throw InvalidInput("LAS header: " + message); }

void check_version(Bytes bytes) {
  if (bytes.size() < kSmallestHeader) {
    refuse("needs " + std::to_string(kSmallestHeader) + " bytes, but the file has only " +
           std::to_string(bytes.size()) + ": it is truncated");
  }
  const auto major = load<std::uint8_t>(bytes.data() + at::kVersionMajor);
  const auto minor = load<std::uint8_t>(bytes.data() + at::kVersionMinor);
  if (!as_text(bytes).starts_with("LASF")) refuse("does not begin with LASF");
  if (major != 1 || minor < 2 || minor > 4) {
    refuse("version " + std::to_string(major) + "." + std::to_string(minor) + " is not read; known are 1.2 to 1.4");
  }
  if (bytes.size() < kHeaderBytesOfMinor[minor]) refuse("the file ends within the header: it is truncated");
}

/// From version 1.4 on there are two counts; the older one is zero when it cannot hold the number or the format is new.
std::uint64_t point_count(Bytes bytes) {
  const auto legacy = load<std::uint32_t>(bytes.data() + at::kLegacyPoints);
  if (load<std::uint8_t>(bytes.data() + at::kVersionMinor) < 4) return legacy;
  const auto points = load<std::uint64_t>(bytes.data() + at::kPoints);
  if (points == 0) return legacy;
  if (legacy != 0 && legacy != points) {
    refuse("two numbers of points, " + std::to_string(points) + " and " + std::to_string(legacy));
  }
  return points;
}

std::size_t record_bytes(Bytes bytes) {
  const auto format = load<std::uint8_t>(bytes.data() + at::kPointFormat);
  // LASzip marks compressed points by the highest bits of the format.
  if ((format & 0xC0) != 0) refuse("the points are compressed (LAZ), which is not read; please decompress them to LAS");
  if (format >= kRecordBytesOfFormat.size()) {
    refuse("point format " + std::to_string(format) + " is not read; known are 0 to 10");
  }
  const auto bytes_per_point = load<std::uint16_t>(bytes.data() + at::kRecordBytes);
  if (bytes_per_point < kRecordBytesOfFormat[format]) {
    refuse("records of " + std::to_string(bytes_per_point) + " bytes are too short for point format " +
           std::to_string(format) + ", which needs " + std::to_string(kRecordBytesOfFormat[format]));
  }
  return bytes_per_point;
}

Eigen::Array3d three_doubles(const std::byte* at) {
  return {load<double>(at), load<double>(at + sizeof(double)), load<double>(at + 2 * sizeof(double))};
}

LasHeader parse_header(Bytes bytes) {
  check_version(bytes);
  LasHeader header;
  header.record_bytes = record_bytes(bytes);
  header.points = point_count(bytes);
  header.points_offset = load<std::uint32_t>(bytes.data() + at::kPointsOffset);
  const auto minor = load<std::uint8_t>(bytes.data() + at::kVersionMinor);
  const auto header_bytes = load<std::uint16_t>(bytes.data() + at::kHeaderBytes);
  if (header_bytes < kHeaderBytesOfMinor[minor] || header.points_offset < header_bytes) {
    refuse("its size " + std::to_string(header_bytes) + " and the offset to the points " +
           std::to_string(header.points_offset) + " contradict version 1." + std::to_string(minor));
  }
  if (header.points_offset > bytes.size()) {
    refuse("the points begin at byte " + std::to_string(header.points_offset) + ", but the file has only " +
           std::to_string(bytes.size()) + " bytes: it is truncated");
  }
  header.scale_m = three_doubles(bytes.data() + at::kScale);
  header.origin_m = three_doubles(bytes.data() + at::kOrigin);
  if (!header.scale_m.allFinite() || (header.scale_m == 0.0).any()) refuse("a scale factor is zero or not finite");
  if (!header.origin_m.allFinite()) refuse("an offset is not finite");
  return header;
}

/// Every point format begins with X Y Z (i32) and the intensity (u16).
PointCloud read_points(const LasHeader& header, Bytes records, const Placement& placement) {
  constexpr std::size_t kIntensity = 3 * sizeof(std::int32_t);
  PointCloud cloud;
  cloud.reserve(header.points);
  cloud.intensity.reserve(header.points);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    const std::byte* record = records.data() + i * header.record_bytes;
    const Eigen::Array3d steps(load<std::int32_t>(record), load<std::int32_t>(record + 4),
                               load<std::int32_t>(record + 8));
    append_placed(cloud, placement, (steps * header.scale_m + header.origin_m).matrix());
    cloud.intensity.push_back(load<std::uint16_t>(record + kIntensity));
  }
  return cloud;
}

}  // namespace

std::vector<DecodedScan> decode_las(Bytes bytes, const ScanHints& hints, const ScanFileLimits& limits) {
  const LasHeader header = parse_header(bytes);
  const Placement placement = placement_of(hints, Frame::world, std::nullopt);
  const Bytes records = bytes.subspan(header.points_offset);
  check_promise("the LAS header", header.points, header.record_bytes, records.size(), limits);
  return single_scan(read_points(header, records, placement), placement.world_from_sensor);
}

}  // namespace raywatch
