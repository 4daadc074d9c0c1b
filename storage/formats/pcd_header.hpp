#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "storage/formats/numbers.hpp"

namespace raywatch {

enum class PcdData { ascii, binary, binary_compressed };

struct PcdField {
  std::string name;
  NumberType type = NumberType::f32;
  std::uint64_t count = 1;   ///< numbers of this type in one point
  std::uint64_t offset = 0;  ///< in bytes, within one point
  std::uint64_t column = 0;  ///< of the first of its numbers, in a line of an ascii file
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t width = 0;
  std::uint64_t height = 1;
  std::uint64_t points = 0;
  std::uint64_t point_bytes = 0;                       ///< of one point, in binary files
  std::uint64_t point_columns = 0;                     ///< of one point, in ascii files
  std::optional<Pose> viewpoint;                       ///< world_from_sensor; an identity counts as absent
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< from a comment "origin_m x y z"
  PcdData data = PcdData::ascii;
  std::size_t data_offset = 0;  ///< of the first byte after the header
  std::size_t lines = 0;        ///< of the header
};

/// Reads the header of a PCD file (versions 0.5 to 0.7), strictly.
/// @throws InvalidInput naming line and entry when it is incomplete, contradicts itself or holds an unknown entry.
PcdHeader parse_pcd_header(std::string_view file);

}  // namespace raywatch
