#include "tests/fuzz/fuzz_scan_file.hpp"

#include <cstdlib>
#include <span>

#include "core/error.hpp"
#include "storage/formats/decode.hpp"

using namespace raywatch;

namespace {

ScanHints hints_from(std::uint8_t choice) {
  constexpr std::uint8_t kFormats = 6;
  constexpr std::uint8_t kWorldBit = 0x08;
  constexpr std::uint8_t kPoseBit = 0x10;
  ScanHints hints;
  if (const auto format = static_cast<std::uint8_t>(choice % (kFormats + 1)); format < kFormats) {
    hints.format = static_cast<ScanFormat>(format);
  }
  if ((choice & kWorldBit) != 0) hints.frame = Frame::world;
  if ((choice & kPoseBit) != 0) hints.pose = Pose{.position_m = {1.0, 2.0, 3.0}};
  return hints;
}

/// What `PointCloud` promises of whoever fills it.
void check_invariants(const DecodedScan& scan) {
  const PointCloud& cloud = scan.points;
  const std::size_t n = cloud.size();
  const bool planes_agree = cloud.y_m.size() == n && cloud.z_m.size() == n;
  const bool intensity_agrees = cloud.intensity.empty() || cloud.intensity.size() == n;
  const bool grid_agrees = !cloud.grid || std::uint64_t{cloud.grid->rows} * cloud.grid->columns == n;
  if (n == 0 || !planes_agree || !intensity_agrees || !grid_agrees) std::abort();
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr ScanFileLimits kLimits{.max_points = 1'000'000, .max_bytes = 64 << 20};
  try {
    const auto scans = decode_scan(std::as_bytes(std::span(data, size)).subspan(1), "", hints_from(data[0]), kLimits);
    for (const DecodedScan& scan : scans) check_invariants(scan);
  } catch (const Error&) {
    return 0;
  }
  return 0;
}
