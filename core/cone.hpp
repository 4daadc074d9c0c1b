#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

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

  /// True if the cone reaches, from wherever in its cell the axis is, all directions that are no farther from there
  /// than one cell sideways and `rows` cells up or down.
  bool encloses_block_of_axis(const DirectionGrid& grid, double rows) const {
    return std::hypot(1.0, rows) * grid.cell_rad() <= inner_rad_;
  }

  /// Calls `visit(cell, inside)` for the cells that the cone around `axis` touches, row by row from the lowest, until
  /// it returns false.
  template <class Visit>
  void for_each_cell(const DirectionGrid& grid, const Direction& axis, Visit&& visit) const {
    for_each_row(grid, axis, [&](std::uint32_t row, const Columns& outer, double cosine) {
      const auto columns = static_cast<std::int64_t>(grid.columns(row));
      const Columns inner = inner_columns(grid, axis, row, cosine, outer);
      for (std::int64_t column = outer.first; column <= outer.last; ++column) {
        const bool inside = inner.first <= column && column <= inner.last;
        const std::int64_t wrapped = column < 0 ? column + columns : column >= columns ? column - columns : column;
        if (!visit(grid.first_cell(row) + static_cast<std::uint32_t>(wrapped), inside)) return false;
      }
      return true;
    });
  }

  /// Calls `visit(first, end)` for the stretches of neighbouring cells first..end - 1 that the cone around `axis`
  /// touches, in the same order: one a row or, at the seam, two. Until it returns false.
  template <class Visit>
  void for_each_stretch(const DirectionGrid& grid, const Direction& axis, Visit&& visit) const {
    for_each_row(grid, axis, [&](std::uint32_t row, const Columns& outer, double) {
      return visit_stretches(grid, row, outer, visit);
    });
  }

  /// The same for the box of azimuths and elevations around the cone: more cells, but found much faster.
  template <class Visit>
  void for_each_stretch_of_box(const DirectionGrid& grid, const Direction& axis, Visit&& visit) const {
    const double sine = std::sin(outer_rad_), cosine = std::cos(static_cast<double>(axis.elevation_rad));
    const double half_rad = sine < cosine ? std::asin(sine / cosine) + kMargin_rad : std::numbers::pi;
    const Rows rows = rows_of(grid, axis);
    for (std::uint32_t row = rows.first; row < rows.end; ++row) {
      if (!visit_stretches(grid, row, columns_within(grid, axis, row, half_rad), visit)) return;
    }
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

  /// floor(value) as a whole number, without the call that it is where the compiler must do without SSE 4.1.
  static std::int64_t floor_of(double value) {
    const auto whole = static_cast<std::int64_t>(value);
    return value < static_cast<double>(whole) ? whole - 1 : whole;
  }
  static std::int64_t ceil_of(double value) { return -floor_of(-value); }

  /// Columns first..last of a row. They may reach below 0 or beyond the last column, where the row wraps around, but
  /// are never more than the row has.
  struct Columns {
    std::int64_t first = 0, last = -1;
  };

  /// Rows first..end - 1 of the grid.
  struct Rows {
    std::uint32_t first = 0, end = 0;
  };
  Rows rows_of(const DirectionGrid& grid, const Direction& axis) const {
    const double low = grid.row_coordinate(axis.elevation_rad - outer_rad_);
    const double high = grid.row_coordinate(axis.elevation_rad + outer_rad_);
    if (grid.rows() == 0 || high < 0.0 || low >= static_cast<double>(grid.rows())) return {};
    const auto last = static_cast<std::uint32_t>(std::min(high, static_cast<double>(grid.rows() - 1)));
    return {static_cast<std::uint32_t>(std::max(low, 0.0)), last + 1};
  }

  static Columns columns_within(const DirectionGrid& grid, const Direction& axis, std::uint32_t row, double half_rad) {
    const auto columns = static_cast<std::int64_t>(grid.columns(row));
    const double half = half_rad * static_cast<double>(columns) / (2.0 * std::numbers::pi);
    const double center = grid.column_coordinate(row, axis.azimuth_rad);
    const Columns within{floor_of(center - half), floor_of(center + half)};
    return within.last - within.first >= columns ? Columns{0, columns - 1} : within;
  }

  template <class Visit>
  static bool visit_stretches(const DirectionGrid& grid, std::uint32_t row, const Columns& touched, Visit& visit) {
    const auto columns = static_cast<std::int64_t>(grid.columns(row));
    const auto stretch = [&](std::int64_t first, std::int64_t end) {
      const std::uint32_t cell = grid.first_cell(row);
      return first >= end || visit(cell + static_cast<std::uint32_t>(first), cell + static_cast<std::uint32_t>(end));
    };
    const std::int64_t first = touched.first, end = touched.last + 1;
    return stretch(first + columns, std::min(columns, end + columns)) &&
           stretch(std::max<std::int64_t>(first, 0), std::min(columns, end)) && stretch(0, end - columns);
  }

  /// Calls `visit(row, columns that the cone touches, cosine of the axis' elevation)` until it returns false.
  template <class Visit>
  void for_each_row(const DirectionGrid& grid, const Direction& axis, Visit&& visit) const {
    const double cosine = std::max(0.0, std::cos(static_cast<double>(axis.elevation_rad)));
    const Rows rows = rows_of(grid, axis);
    for (std::uint32_t row = rows.first; row < rows.end; ++row) {
      const std::optional<Columns> outer = outer_columns(grid, axis, row, cosine);
      if (outer && !visit(row, *outer, cosine)) return;
    }
  }

  // How far a cone reaches in azimuth within a row follows from
  // hav(angle) = hav(elevation difference) + cos(elevation) cos(elevation') hav(azimuth difference).

  /// Those that contain the part of the cone in a row, if it touches that.
  std::optional<Columns> outer_columns(const DirectionGrid& grid, const Direction& axis, std::uint32_t row,
                                       double cosine) const {
    const double bottom = grid.row_bottom_rad(row), top = bottom + grid.cell_rad();
    const double nearest = std::max({0.0, bottom - axis.elevation_rad, axis.elevation_rad - top});
    const double rest = outer_haversine_ - haversine(nearest), scale = cosine * grid.least_cosine(row);
    if (rest < 0.0) return std::nullopt;
    return columns_within(grid, axis, row,
                          rest < scale ? angle_of_haversine(rest / scale) + kMargin_rad : std::numbers::pi);
  }

  /// Those that the cone contains, of the columns `outer` that it touches.
  Columns inner_columns(const DirectionGrid& grid, const Direction& axis, std::uint32_t row, double cosine,
                        const Columns& outer) const {
    const double bottom = grid.row_bottom_rad(row), top = bottom + grid.cell_rad();
    const double farthest = std::max(std::abs(axis.elevation_rad - bottom), std::abs(axis.elevation_rad - top));
    const double rest = inner_haversine_ - haversine(farthest), scale = cosine * grid.greatest_cosine(row);
    if (rest < 0.0) return {};
    if (rest >= scale) return outer;
    const double half_rad = angle_of_haversine(rest / scale) - kMargin_rad;
    if (half_rad <= 0.0) return {};
    const double half = half_rad * static_cast<double>(grid.columns(row)) / (2.0 * std::numbers::pi);
    const double center = grid.column_coordinate(row, axis.azimuth_rad);
    return {std::max(outer.first, ceil_of(center - half)), std::min(outer.last, floor_of(center + half) - 1)};
  }

  double outer_rad_, inner_rad_;
  double outer_haversine_, inner_haversine_;
};

}  // namespace raywatch
