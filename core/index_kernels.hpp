#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/direction_grid.hpp"
#include "core/point_cloud.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {

/// Coordinates of points, plane by plane.
struct PointPlanes {
  const float* x_m = nullptr;
  const float* y_m = nullptr;
  const float* z_m = nullptr;
  std::size_t size = 0;

  PointPlanes subspan(std::size_t begin, std::size_t count) const {
    return {x_m + begin, y_m + begin, z_m + begin, count};
  }
};
inline PointPlanes planes_of(const PointCloud& points) {
  return {points.x_m.data(), points.y_m.data(), points.z_m.data(), points.size()};
}

/// 1 for each point that `is_usable` holds for, else 0.
void find_usable(const PointPlanes& points, const UsableRange& usable, std::uint8_t* valid);

/// How many points are usable, and bounds of their elevations (0 and 0 when none is).
struct ScannedBand {
  std::size_t count = 0;
  double low_rad = 0.0;
  double high_rad = 0.0;
};
ScannedBand find_elevation_band(const PointPlanes& points, const UsableRange& usable);

inline constexpr std::uint32_t kNoCell = std::numeric_limits<std::uint32_t>::max();

/// The cell of each point; `kNoCell` where it is not usable. The grid must have a row.
void assign_cells(const PointPlanes& points, const UsableRange& usable, const DirectionGridView& grid,
                  std::uint32_t* cells);

/// The least and the greatest range of each cell's returns, which stand from `first[cell]` to `first[cell + 1]`;
/// infinity and -infinity where there are none. `first` may be loaded `RawArray::kPadding` past its end.
void bound_ranges(const Return* returns, const std::uint32_t* first, std::size_t cells, float* least_m,
                  float* greatest_m);

/// Ranges, azimuths and elevations: the bare transform to spherical coordinates, against which all else is measured.
void to_spherical(const PointPlanes& points, float* ranges_m, float* azimuths_rad, float* elevations_rad);

}  // namespace raywatch
