#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace raywatch {

/// The order in which a sensor took its shots: point `row * columns + column`. A cell without a return keeps its place
/// (NaN, or zero range), so that "no return" and "not measured" stay different.
struct ShotGrid {
  std::uint32_t rows = 0;
  std::uint32_t columns = 0;
  friend bool operator==(const ShotGrid&, const ShotGrid&) = default;
};

/// The returns of one scan in the sensor frame, plane by plane, bit-exact as they were received and in their order.
/// Invariant kept by whoever fills it: the planes have one length; `intensity` is empty or of the same length; a grid's
/// rows * columns is that length.
struct PointCloud {
  std::vector<float> x_m, y_m, z_m;
  std::vector<float> intensity;  ///< empty when the scan has none; the unit is the sensor's own
  std::optional<ShotGrid> grid;

  std::size_t size() const { return x_m.size(); }
  bool empty() const { return x_m.empty(); }
  Eigen::Vector3f operator[](std::size_t i) const { return {x_m[i], y_m[i], z_m[i]}; }
  void reserve(std::size_t n) {
    x_m.reserve(n);
    y_m.reserve(n);
    z_m.reserve(n);
  }
  void push_back(float x, float y, float z) {
    x_m.push_back(x);
    y_m.push_back(y);
    z_m.push_back(z);
  }
};

/// Which returns count as measurements of a surface. Everything else is of class `invalid`.
struct UsableRange {
  double min_m = 0.0;                      ///< nearer returns are the rig itself; zero range never counts
  double max_m = 1e9;                      ///< farther returns are errors or a sentinel for "no return"
  std::optional<double> no_return_m = {};  ///< a range that the sensor reports instead of "no return"
};

/// Half the width of the band around `UsableRange::no_return_m` that is taken for the sentinel: receivers of one
/// scanner may report it some millimetres apart.
inline constexpr double kNoReturnBand_m = 1e-2;

/// True if a return at `range_m` measures a surface.
inline bool is_usable(double range_m, const UsableRange& usable) {
  const bool measured = std::isfinite(range_m) && range_m > 0.0 && range_m >= usable.min_m && range_m <= usable.max_m;
  return measured && !(usable.no_return_m && std::abs(range_m - *usable.no_return_m) <= kNoReturnBand_m);
}

}  // namespace raywatch
