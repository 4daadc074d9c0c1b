#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>

namespace raywatch {

class OutBuffer;
struct PointTable;

/// The coordinates of points; all planes have one length.
struct CoordinatePlanes {
  std::span<const float> x_m, y_m, z_m;

  std::size_t size() const { return x_m.size(); }
  Eigen::Vector3d operator[](std::size_t i) const { return {x_m[i], y_m[i], z_m[i]}; }
};

/// What all parts of a set of points are quantised with, so that they fit together.
struct Quantisation {
  Eigen::AlignedBox3d box_m;  ///< around the finite points; empty without any
  float intensity_low = 0.0F, intensity_high = 0.0F;
  std::uint64_t total = 0;  ///< the finite points of the set
  std::uint64_t first = 0;  ///< the place in the set of the part's first point

  /// The length of one step along each axis, in metres; zero along an axis without extent.
  Eigen::Vector3d step_m() const;
};

/// @param intensity empty, or one for each point
Quantisation quantisation_of(const CoordinatePlanes& points, std::span<const float> intensity);

/// Writes the finite points of a table, little endian:
/// - "RWPQ", u32 version = 1, u64 points, u64 total, u64 first
/// - 3 f64 origin_m, 3 f64 step_m: a coordinate is origin + step * number, at most half a step from the measured one
/// - 2 f32: the intensities that 0 and 255 stand for
/// - u32 flags (1: there are classes, 2: there are intensities), u32 0
/// - for each point u16 x, y, z, u8 class, u8 intensity; what is not there is 0
/// The table's quantisation is used, or one of its own points when it has none.
void write_quantised(OutBuffer& out, const PointTable& table);

}  // namespace raywatch
