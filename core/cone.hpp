#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/direction_grid.hpp"

namespace raywatch {

/// The columns of one row of a grid that a cone touches, and those among them that lie inside of it. Both are closed
/// intervals that may reach below 0 or beyond the last column, where the row wraps around; they are never longer than
/// the row. `inner_first > inner_last` when no column is inside.
struct ConeRow {
  std::uint32_t row = 0;
  std::int64_t first = 0, last = -1;
  std::int64_t inner_first = 0, inner_last = -1;
};

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

  /// True if the cone reaches, from wherever in its cell the axis is, all directions that are no farther from there
  /// than one cell sideways and `rows` cells up or down.
  bool encloses_block_of_axis(const DirectionGrid& grid, double rows) const {
    return std::hypot(1.0, rows) * grid.cell_rad() <= inner_rad_;
  }

  /// Calls `visit(ConeRow)` for the rows that the cone around `axis` touches, from the lowest, until it returns false.
  template <class Visit>
  void for_each_row(const DirectionGrid& grid, const Direction& axis, Visit&& visit) const {
    const double elevation = axis.elevation_rad;
    const double low = grid.row_coordinate(elevation - outer_rad_);
    const double high = grid.row_coordinate(elevation + outer_rad_);
    if (grid.rows() == 0 || high < 0.0 || low >= static_cast<double>(grid.rows())) return;
    const auto first = static_cast<std::uint32_t>(std::max(low, 0.0));
    const auto last = static_cast<std::uint32_t>(std::min(high, static_cast<double>(grid.rows() - 1)));
    const double cosine = std::max(0.0, std::cos(elevation));
    for (std::uint32_t row = first; row <= last; ++row) {
      const Widths half = widths(grid, elevation, cosine, row);
      if (half.outer_rad >= 0.0 && !visit(columns_of(grid, axis.azimuth_rad, row, half))) return;
    }
  }

  /// Calls `visit(cell, inside)` for the cells that the cone around `axis` touches, until it returns false.
  template <class Visit>
  void for_each_cell(const DirectionGrid& grid, const Direction& axis, Visit&& visit) const {
    for_each_row(grid, axis, [&](const ConeRow& cover) {
      const auto columns = static_cast<std::int64_t>(grid.columns(cover.row));
      for (std::int64_t column = cover.first; column <= cover.last; ++column) {
        const bool inside = cover.inner_first <= column && column <= cover.inner_last;
        const std::int64_t wrapped = column < 0 ? column + columns : column >= columns ? column - columns : column;
        if (!visit(grid.first_cell(cover.row) + static_cast<std::uint32_t>(wrapped), inside)) return false;
      }
      return true;
    });
  }

 private:
  /// Covers the errors of the directions of the axis and of the returns, and of the arithmetic on them.
  static constexpr double kMargin_rad = 8.0 * kDirectionError_rad;

  /// hav(x) = sin^2(x / 2). The series is off by less than 1e-12 where it is used, far below the margin.
  static double haversine(double angle_rad) {
    const double squared = angle_rad * angle_rad;
    if (squared < 0.01) return 0.25 * squared * (1.0 - squared * (1.0 / 12.0 - squared * (1.0 / 360.0)));
    const double half = std::sin(0.5 * angle_rad);
    return half * half;
  }
  /// The angle whose haversine is `value` in 0..1. The series is off by less than 1e-10 where it is used.
  static double angle_of_haversine(double value) {
    const double sine = std::sqrt(value);
    if (value < 0.01) return 2.0 * sine * (1.0 + value * (1.0 / 6.0 + value * (3.0 / 40.0 + value * (15.0 / 336.0))));
    return 2.0 * std::asin(sine);
  }

  /// The half-widths in azimuth that contain, and that are contained in, the part of the cone in a row. From
  /// hav(angle) = hav(elevation difference) + cos(elevation) cos(elevation') hav(azimuth difference).
  struct Widths {
    double outer_rad = std::numbers::pi;
    double inner_rad = -1.0;
  };
  Widths widths(const DirectionGrid& grid, double elevation, double cosine, std::uint32_t row) const {
    const double bottom = grid.row_bottom_rad(row), top = bottom + grid.cell_rad();
    const double nearest = std::max({0.0, bottom - elevation, elevation - top});
    const double farthest = std::max(std::abs(elevation - bottom), std::abs(elevation - top));
    Widths result;
    const double outer = outer_haversine_ - haversine(nearest);
    const double outer_scale = cosine * grid.least_cosine(row);
    if (outer < 0.0) {
      result.outer_rad = -1.0;
    } else if (outer < outer_scale) {
      result.outer_rad = angle_of_haversine(outer / outer_scale) + kMargin_rad;
    }
    const double inner = inner_haversine_ - haversine(farthest);
    const double inner_scale = cosine * grid.greatest_cosine(row);
    if (inner >= 0.0) {
      result.inner_rad =
          inner < inner_scale ? angle_of_haversine(inner / inner_scale) - kMargin_rad : 2.0 * std::numbers::pi;
    }
    return result;
  }

  /// floor(value) as a whole number, without the call that it is where the compiler must do without SSE 4.1.
  static std::int64_t floor_of(double value) {
    const auto whole = static_cast<std::int64_t>(value);
    return value < static_cast<double>(whole) ? whole - 1 : whole;
  }
  static std::int64_t ceil_of(double value) { return -floor_of(-value); }

  static ConeRow columns_of(const DirectionGrid& grid, double azimuth_rad, std::uint32_t row, const Widths& half) {
    const auto columns = static_cast<std::int64_t>(grid.columns(row));
    const double per_rad = static_cast<double>(columns) / (2.0 * std::numbers::pi);
    const double center = grid.column_coordinate(row, azimuth_rad);
    ConeRow cover{.row = row,
                  .first = floor_of(center - half.outer_rad * per_rad),
                  .last = floor_of(center + half.outer_rad * per_rad)};
    if (cover.last - cover.first >= columns) {
      cover.first = 0;
      cover.last = columns - 1;
    }
    if (half.inner_rad >= std::numbers::pi) {
      cover.inner_first = cover.first;
      cover.inner_last = cover.last;
    } else if (half.inner_rad > 0.0) {
      const double reach = half.inner_rad * per_rad;
      cover.inner_first = std::max(cover.first, ceil_of(center - reach));
      cover.inner_last = std::min(cover.last, floor_of(center + reach) - 1);
    }
    return cover;
  }

  double outer_rad_, inner_rad_;
  double outer_haversine_, inner_haversine_;
};

}  // namespace raywatch
