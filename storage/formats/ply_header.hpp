#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/numbers.hpp"

namespace raywatch {

enum class PlyData { ascii, binary_little_endian, binary_big_endian };

struct PlyProperty {
  std::string name;
  NumberType type = NumberType::f32;  ///< of a list: of its items
  bool is_list = false;
  std::uint64_t offset = 0;  ///< in bytes, within one record; means nothing after a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::uint64_t record_bytes = 0;  ///< without its lists
  bool has_list = false;
};

struct PlyHeader {
  PlyData data = PlyData::ascii;
  std::vector<PlyElement> elements;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< from a comment "origin_m x y z"
  std::size_t data_offset = 0;                         ///< of the first byte after the header
  std::size_t lines = 0;                               ///< of the header
};

/// Reads the header of a PLY file (version 1.0).
/// @throws InvalidInput naming the line when it is incomplete or not understood.
PlyHeader parse_ply_header(std::string_view file);

}  // namespace raywatch
