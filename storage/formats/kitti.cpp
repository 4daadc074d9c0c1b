#include "core/error.hpp"
#include "storage/formats/decode.hpp"
#include "storage/formats/records.hpp"

namespace raywatch {

/// KITTI's velodyne files: nothing but records of four little-endian floats, x y z intensity.
std::vector<DecodedScan> decode_kitti(std::span<const std::byte> bytes, const ScanHints& hints,
                                      const ScanFileLimits& limits) {
  constexpr std::size_t kRecord = 4 * sizeof(float);
  if (bytes.size() % kRecord != 0) {
    throw InvalidInput("a KITTI file consists of records of 16 bytes, but this one has " +
                       std::to_string(bytes.size()) + " bytes: it is truncated or of another format");
  }
  const std::size_t count = bytes.size() / kRecord;
  check_promise("the size of the file", count, kRecord, bytes.size(), limits);
  const auto view = [&](std::size_t field) {
    return FieldView{bytes.data() + field * sizeof(float), kRecord, NumberType::f32};
  };
  const Placement placement = placement_of(hints, Frame::sensor, std::nullopt);
  return single_scan(read_point_fields({view(0), view(1), view(2), view(3)}, count, placement),
                     placement.world_from_sensor);
}

}  // namespace raywatch
