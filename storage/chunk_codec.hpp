#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/point_cloud.hpp"
#include "storage/sealed_block.hpp"

namespace raywatch {

/// So many points are put into one chunk: a question about one direction reads little, and chunks still compress well.
inline constexpr std::size_t kChunkPoints = 512;
/// At most so many points stand in one chunk that was stored at any time.
inline constexpr std::size_t kMostChunkPoints = 8192;

/// What directions and ranges the points of a chunk have in the sensor frame. Azimuths run from `azimuth_min_rad` in
/// (-pi, pi] upwards to `azimuth_max_rad`, which is above pi when they cross the seam.
struct ChunkBounds {
  double azimuth_min_rad = 0.0, azimuth_max_rad = 0.0;
  double elevation_min_rad = 0.0, elevation_max_rad = 0.0;
  double range_min_m = 0.0, range_max_m = 0.0;
};

/// The bounds of some points; nothing if none has a direction (all at zero range or not finite).
std::optional<ChunkBounds> chunk_bounds(std::span<const float> x_m, std::span<const float> y_m,
                                        std::span<const float> z_m);

/// A cone from the sensor, in the sensor frame.
struct DirectionCone {
  Eigen::Vector3d direction;    ///< of any length but zero
  double half_angle_rad = 0.0;  ///< 0..pi
};

/// The elevations of the directions in a cone, and a little more than these.
struct ElevationBand {
  double min_rad = 0.0, max_rad = 0.0;
};
ElevationBand elevation_band(const DirectionCone& cone);

/// False only if no point within `bounds` lies in the cone. May be true for some that hold none.
bool may_meet(const ChunkBounds& bounds, const DirectionCone& cone);

/// Points `first`, `first + 1`, ... of a cloud, at most `kMostChunkPoints`, as a sealed block; bit-exact.
std::vector<std::uint8_t> encode_chunk(const PointCloud& points, std::size_t first, std::size_t count,
                                       BlockSealer& sealer);

/// Appends the points of a chunk. `with_intensity` is what the scan has: a chunk that differs is corrupt.
/// @throws CorruptData; then `points` is as before.
void decode_chunk(std::span<const std::uint8_t> block, bool with_intensity, PointCloud& points);

}  // namespace raywatch
