#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace raywatch {

/// Square cells in the horizontal plane, row by row: cell (0, 0) has its lowest corner at the origin, columns count
/// along x, rows along y.
struct GridLayout {
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();
  double cell_m = 1.0;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;

  std::size_t cell_count() const { return std::size_t{columns} * rows; }
  double cell_area_m2() const { return cell_m * cell_m; }
  Eigen::Vector2d center_m(std::size_t cell) const {
    const Eigen::Vector2d steps(static_cast<double>(cell % columns), static_cast<double>(cell / columns));
    return origin_m + cell_m * (steps + Eigen::Vector2d::Constant(0.5));
  }
  /// The cell at a place; nothing outside.
  std::optional<std::size_t> cell_at(double x_m, double y_m) const {
    const double column = std::floor((x_m - origin_m.x()) / cell_m), row = std::floor((y_m - origin_m.y()) / cell_m);
    if (!(column >= 0.0 && row >= 0.0 && column < columns && row < rows)) return std::nullopt;
    return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
  }
  friend bool operator==(const GridLayout&, const GridLayout&) = default;
};

/// The cells that cover an area, with corners at multiples of the cell, so that the grids of two epochs coincide.
/// @throws InvalidInput naming `cell_m` unless it is above 0 and there are at most 25 million cells.
GridLayout layout_over(const Eigen::AlignedBox2d& area_m, double cell_m);

}  // namespace raywatch
