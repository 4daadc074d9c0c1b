#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/point_cloud.hpp"

namespace raywatch {

/// What stands for the place of a surface in the cylinder.
enum class M3c2Statistic : std::uint8_t {
  mean,    ///< with the standard deviation
  median,  ///< with the interquartile range
};

/// The scales of M3C2; all in metres, above 0.
struct M3c2Parameters {
  double normal_diameter_m = 2.0;      ///< D: the normal is that of the surface within a ball of this diameter
  double projection_diameter_m = 1.0;  ///< d: of the cylinder in which both surfaces are looked for
  double max_distance_m = 5.0;         ///< the cylinder reaches this far to either side of the core point
  double registration_m = 0.0;         ///< reg: how well both clouds are aligned
  std::size_t least_points = 5;        ///< of each cloud in the cylinder, for a level of detection
  M3c2Statistic statistic = M3c2Statistic::mean;
};

/// What one cloud has in the cylinder of a core point.
struct M3c2Side {
  std::uint32_t points = 0;
  double position_m = std::numeric_limits<double>::quiet_NaN();  ///< along the normal, from the core point
  double roughness_m = std::numeric_limits<double>::quiet_NaN();
};

/// The change at a core point. NaN: what it needs is not there.
struct M3c2Distance {
  Eigen::Vector3d normal = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());  ///< towards the sensor
  M3c2Side before, after;
  double distance_m = std::numeric_limits<double>::quiet_NaN();  ///< positive: the surface came towards the sensor
  double lod95_m = std::numeric_limits<double>::quiet_NaN();

  bool significant() const { return std::abs(distance_m) > lod95_m; }
};

/// The two clouds (world), and where the first was seen from.
struct M3c2Clouds {
  const PointCloud& before;
  const PointCloud& after;
  std::span<const Eigen::Vector3d> sensors_m;  ///< normals point to the nearest of these; up when there are none
};

/// Multiscale Model to Model Cloud Comparison: D. Lague, N. Brodu, J. Leroux, "Accurate 3D comparison of complex
/// topography with terrestrial laser scanner: application to the Rangitikei canyon (N-Z)", ISPRS Journal of
/// Photogrammetry and Remote Sensing 82 (2013) 10-26.
///
/// At each core point: the normal is the direction of least variance of the first cloud within D / 2 (at least 4
/// points); both clouds are projected on it within a cylinder of diameter d; the distance is that of their means (or
/// medians), and with the standard deviations s1, s2 (of samples, n - 1; or interquartile ranges, as in the paper) and
/// the numbers of points n1, n2
///   LoD95 = 1.96 (sqrt(s1^2 / n1 + s2^2 / n2) + reg).
///
/// Deterministic; runs in the caller's oneTBB arena. Memory: about 40 bytes a point.
/// @throws InvalidInput naming the parameter that is out of its range.
std::vector<M3c2Distance> m3c2(const M3c2Clouds& clouds, std::span<const Eigen::Vector3d> core_points_m,
                               const M3c2Parameters& parameters);

/// Core points: of a cloud (world) one a cube of `spacing_m`, the point that lies nearest to the mean of those in it.
/// In the order of the cubes. @throws InvalidInput unless the spacing is above 0.
std::vector<Eigen::Vector3d> core_points_of(const PointCloud& cloud, double spacing_m);

}  // namespace raywatch
