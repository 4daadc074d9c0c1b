#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "core/pose.hpp"

namespace raywatch::simulator {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// What a scan holds for a shot that nothing came back from.
enum class NoReturn {
  omit,      ///< no point; the scan has no grid of shots
  nan,       ///< a point of NaN in its cell of the grid
  zero,      ///< a point at the origin
  sentinel,  ///< a point at `Scanner::sentinel_range_m` in the direction of the shot
};

/// Everything that makes a scanner worse than geometry. All zero: exact.
struct ScannerErrors {
  double range_noise_m = 0.0;        ///< one standard deviation
  double angular_noise_rad = 0.0;    ///< one standard deviation, in azimuth and in elevation
  double beam_divergence_rad = 0.0;  ///< full angle; 0: the beam is a line and no return is mixed
  double blend_length_m = 1.5;       ///< surfaces farther apart than this are told apart by the pulse, never mixed
  double dropout_share = 0.0;        ///< of the returns, lost at random
  double self_return_share = 0.0;    ///< of the shots, lost to three posts of the rig at 0.4 to 0.7 m
};

/// The directions in which a scanner shoots, one row per elevation and one column per azimuth, and its errors.
/// Azimuth is counted from x towards y, elevation upwards from the xy plane.
struct Scanner {
  std::vector<double> elevations_rad;
  std::vector<double> azimuths_rad;
  double max_range_m = 1000.0;
  NoReturn no_return = NoReturn::omit;
  double sentinel_range_m = 0.0;
  ScannerErrors errors;

  std::size_t shot_count() const { return elevations_rad.size() * azimuths_rad.size(); }
};

/// A regular grid of directions. Azimuth runs from -pi to below pi; elevation from the lowest to the highest, both
/// included.
struct GridAngles {
  double step_rad = radians(1.0);
  double lowest_elevation_rad = radians(-90.0);
  double highest_elevation_rad = radians(90.0);
};
Scanner grid_scanner(const GridAngles& angles);

/// A spinning sensor with the rings of an HDL-64: the upper half of them 1/3 degree apart from +2 down to -8.33
/// degrees, the lower half 1/2 degree apart from -8.83 down to -24.33; another number of rings spans the same angles.
struct RingAngles {
  std::uint32_t rings = 64;
  std::uint32_t azimuth_steps = 1800;
};
Scanner spinning_scanner(const RingAngles& angles);

/// A surveying scanner on a tripod: a full panorama in equal steps, from steep below to the zenith.
struct PanoramaAngles {
  std::uint32_t azimuth_steps = 2000;
  std::uint32_t elevation_steps = 700;
  double lowest_elevation_rad = radians(-60.0);
  double highest_elevation_rad = radians(60.0);
};
Scanner tripod_scanner(const PanoramaAngles& angles);

}  // namespace raywatch::simulator
