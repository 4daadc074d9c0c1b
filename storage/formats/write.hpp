#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "storage/formats/quantise.hpp"

namespace raywatch {

enum class PointFormat { pcd, ply, csv, bin, q16 };

/// @throws InvalidInput naming the known ones, unless "pcd", "ply", "csv", "bin" or "q16".
PointFormat parse_point_format(std::string_view name);
std::string_view media_type(PointFormat format);

/// One more column of a point table besides x, y, z. All columns have as many values as there are points.
struct PointColumn {
  std::string name;
  std::variant<std::span<const float>, std::span<const std::uint8_t>, std::span<const std::int32_t>> values;
  std::span<const std::string_view> labels = {};  ///< of the values of an u8 column: what csv prints instead of them
};

/// A table of points to write. Coordinates are given relative to `origin_m`; text formats print their sum in double,
/// binary ones keep float32 and record the origin (PCD and PLY: a comment "origin_m x y z"; bin: in its header).
struct PointTable {
  std::span<const float> x_m, y_m, z_m;
  std::vector<PointColumn> columns = {};
  std::size_t leading_columns = 0;  ///< of `columns`: how many stand before x, y, z (csv only)
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  Pose viewpoint = {};                            ///< PCD's VIEWPOINT
  std::optional<Quantisation> quantisation = {};  ///< of the points that these are a part of (q16 only)
};

/// Writes the table.
/// - pcd: binary, fields x y z and the columns (F4, U1, I4)
/// - ply: binary little endian, the same properties
/// - csv: header line, then one row a point; numbers round-trip; a column of int32 prints -1 as empty
/// - bin: little endian, "RWPB", u32 version = 1, u64 points, 3 f64 origin_m, u32 number of columns, for each column u8
///   type (0 f32, 1 u8, 2 i32), u8 length of the name, the name; then the planes x, y, z (f32) and that of each column
/// - q16: see `write_quantised`
/// @throws StorageError when the stream fails.
void write_points(std::ostream& out, PointFormat format, const PointTable& table);

/// A scan as a PCD file that `read_scan_file` gives back bit-exact: sensor frame, VIEWPOINT = world_from_sensor,
/// intensity when there is one, HEIGHT x WIDTH from the grid. Two things PCD cannot say: an identity pose reads as
/// absent, and a grid of one row as no grid.
void write_scan_pcd(std::ostream& out, const PointCloud& points, const Pose& world_from_sensor);

}  // namespace raywatch
