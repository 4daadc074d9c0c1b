#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/point_cloud.hpp"
#include "storage/formats/numbers.hpp"
#include "storage/formats/placement.hpp"

namespace raywatch {

/// One field of all points: the number of point i stands at `first + i * stride`.
struct FieldView {
  const std::byte* first = nullptr;
  std::size_t stride = 0;
  NumberType type = NumberType::f32;
};

/// The fields of a binary file that a scan is made of.
struct PointFields {
  FieldView x, y, z;
  std::optional<FieldView> intensity;
  std::endian order = std::endian::little;
};

/// Reads `count` points. The views must hold that many.
/// @throws InvalidInput naming the point when a value does not fit into a float.
PointCloud read_point_fields(const PointFields& fields, std::size_t count, const Placement& placement);

/// Holds a promise of a header against what the file has.
/// @throws InvalidInput when `points` times `bytes_per_point` is more than `bytes_left`; TooLarge when it is possible
///   but more than `limits.max_points`. `place` says where the promise stands ("POINTS in the PCD header").
void check_promise(const std::string& place, std::uint64_t points, std::uint64_t bytes_per_point,
                   std::uint64_t bytes_left, const ScanFileLimits& limits);

}  // namespace raywatch
