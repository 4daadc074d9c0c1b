#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/direction_grid.hpp"

namespace raywatch {

/// The cells of a grid that a cone of directions touches. Conservative in both senses: no cell that holds a return of
/// the cone is left out, and a cell that is called inside holds no return out of it.
class Cone {
 public:
  /// @param angle_rad half-angle, 0 < angle_rad <= pi/2
  explicit Cone(double angle_rad)
      : outer_rad_(angle_rad + kMargin_rad),
        inner_rad_(angle_rad - kMargin_rad),
        outer_haversine_(haversine(outer_rad_)),
        inner_haversine_(inner_rad_ > 0.0 ? haversine(inner_rad_) : -1.0) {}

  /// True if a cell that holds the axis of the cone lies inside of it wherever the axis is in the cell.
  bool encloses_cell_of_axis(const DirectionGrid& grid) const {
    return std::numbers::sqrt2 * grid.cell_rad() <= inner_rad_;
  }

  /// Calls `visit(cell, inside)` for the cells that the cone around `axis` touches, until it returns false.
  template <class Visit>
  void for_each_cell(const DirectionGrid& grid, const Direction& axis, Visit&& visit) const {
    const double elevation = axis.elevation_rad;
    const double low = grid.row_coordinate(elevation - outer_rad_);
    const double high = grid.row_coordinate(elevation + outer_rad_);
    if (grid.rows() == 0 || high < 0.0 || low >= static_cast<double>(grid.rows())) return;
    const auto first = static_cast<std::size_t>(std::max(low, 0.0));
    const auto last = static_cast<std::size_t>(std::min(high, static_cast<double>(grid.rows() - 1)));
    for (std::size_t row = first; row <= last; ++row) {
      if (!visit_row(grid, axis, row, visit)) return;
    }
  }

 private:
  /// Covers the errors of the directions of the axis and of the returns, and of the arithmetic on them.
  static constexpr double kMargin_rad = 8.0 * kDirectionError_rad;

  static double haversine(double angle_rad) {
    const double half = std::sin(0.5 * angle_rad);
    return half * half;
  }

  /// The half-widths in azimuth that contain, and that are contained in, the part of the cone in a row. From
  /// hav(angle) = hav(elevation difference) + cos(elevation) cos(elevation') hav(azimuth difference).
  struct Widths {
    double outer_rad = std::numbers::pi;
    double inner_rad = -1.0;
  };
  Widths widths(const DirectionGrid& grid, double elevation, std::size_t row) const {
    const double bottom = grid.row_bottom_rad(row), top = bottom + grid.cell_rad();
    const double nearest = std::max({0.0, bottom - elevation, elevation - top});
    const double farthest = std::max(std::abs(elevation - bottom), std::abs(elevation - top));
    const double cosine = std::max(0.0, std::cos(elevation));
    Widths result;
    const double outer = outer_haversine_ - haversine(nearest);
    const double outer_scale = cosine * grid.least_cosine(row);
    if (outer < 0.0) {
      result.outer_rad = -1.0;
    } else if (outer < outer_scale) {
      result.outer_rad = 2.0 * std::asin(std::sqrt(outer / outer_scale)) + kMargin_rad;
    }
    const double inner = inner_haversine_ - haversine(farthest);
    const double inner_scale = cosine * grid.greatest_cosine(row);
    if (inner >= 0.0) {
      result.inner_rad =
          inner < inner_scale ? 2.0 * std::asin(std::sqrt(inner / inner_scale)) - kMargin_rad : 2.0 * std::numbers::pi;
    }
    return result;
  }

  template <class Visit>
  bool visit_row(const DirectionGrid& grid, const Direction& axis, std::size_t row, Visit& visit) const {
    const Widths half = widths(grid, axis.elevation_rad, row);
    if (half.outer_rad < 0.0) return true;
    const auto columns = static_cast<std::int64_t>(grid.columns(row));
    const double per_rad = static_cast<double>(columns) / (2.0 * std::numbers::pi);
    const double center = grid.column_coordinate(row, axis.azimuth_rad);
    auto first = static_cast<std::int64_t>(std::floor(center - half.outer_rad * per_rad));
    auto last = static_cast<std::int64_t>(std::floor(center + half.outer_rad * per_rad));
    if (last - first >= columns) {
      first = 0;
      last = columns - 1;
    }
    const bool whole_row_is_inside = half.inner_rad >= std::numbers::pi;
    const double inner_low = center - half.inner_rad * per_rad, inner_high = center + half.inner_rad * per_rad;
    for (std::int64_t column = first; column <= last; ++column) {
      const bool inside = whole_row_is_inside || (half.inner_rad > 0.0 && static_cast<double>(column) >= inner_low &&
                                                  static_cast<double>(column + 1) <= inner_high);
      const std::int64_t wrapped = column < 0 ? column + columns : column >= columns ? column - columns : column;
      if (!visit(grid.first_cell(row) + static_cast<std::uint32_t>(wrapped), inside)) return false;
    }
    return true;
  }

  double outer_rad_, inner_rad_;
  double outer_haversine_, inner_haversine_;
};

}  // namespace raywatch
