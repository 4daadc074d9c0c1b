#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace raywatch {

/// A direction as angles: azimuth in -pi..pi from the x axis towards y, elevation in -pi/2..pi/2 from the xy plane.
struct Direction {
  float azimuth_rad = 0.0f;
  float elevation_rad = 0.0f;
};

/// Upper bound of the error of `direction_of`, in radians.
inline constexpr double kDirectionError_rad = 1e-6;

/// The direction of a vector, in single precision: good enough to find a cell, never to decide a threshold.
template <class Scalar>
Direction direction_of(Scalar x, Scalar y, Scalar z) {
  const auto xf = static_cast<float>(x), yf = static_cast<float>(y), zf = static_cast<float>(z);
  return {std::atan2(yf, xf), std::atan2(zf, std::hypot(xf, yf))};
}

/// The tables of a `DirectionGrid` as vector code reads them. Cell = first[row] + column, with
/// row = floor((elevation - low) * rows_per_rad) and column = floor((azimuth / 2 pi + 1/2) * columns[row]), each kept
/// within its bounds. The tables may be loaded `kPadding` entries past their ends.
struct DirectionGridView {
  static constexpr std::size_t kPadding = 16;
  float low_rad = 0.0f;
  float rows_per_rad = 1.0f;
  std::int32_t rows = 0;
  float cell_rad = 1.0f;
  const float* columns = nullptr;        ///< number of columns, one a row
  const std::uint32_t* first = nullptr;  ///< first cell, one a row
};

/// A partition of a band of the sphere into cells of nearly equal size: rows of one height, each cut into as many
/// columns as keep a cell no wider than it is high. It has no seam (columns wrap around) and no
/// crowded poles.
class DirectionGrid {
 public:
  DirectionGrid() = default;

  /// @param low_rad,high_rad the band of elevations. @param cell_rad the height of a row, > 0.
  DirectionGrid(double low_rad, double high_rad, double cell_rad) : low_rad_(low_rad), cell_rad_(cell_rad) {
    const auto rows = static_cast<std::size_t>(std::floor((high_rad - low_rad) / cell_rad)) + 1;
    first_.reserve(rows + 1 + DirectionGridView::kPadding);
    columns_.reserve(rows + DirectionGridView::kPadding);
    first_.push_back(0);
    for (std::size_t row = 0; row < rows; ++row) {
      const double bottom = row_bottom_rad(row), top = bottom + cell_rad;
      const double at_bottom = std::max(0.0, std::cos(bottom)), at_top = std::max(0.0, std::cos(top));
      const double least = top >= std::numbers::pi / 2 ? 0.0 : std::min(at_bottom, at_top);
      const double greatest = bottom <= 0.0 && top >= 0.0 ? 1.0 : std::max(at_bottom, at_top);
      least_cosine_.push_back(static_cast<float>(least * (1.0 - kCosineMargin)));
      greatest_cosine_.push_back(static_cast<float>(greatest * (1.0 + kCosineMargin)));
      const double widest = 2.0 * std::numbers::pi * greatest;
      const auto columns = static_cast<std::uint32_t>(std::max(1.0, std::ceil(widest / cell_rad)));
      first_.push_back(first_.back() + columns);
      columns_.push_back(static_cast<float>(columns));
    }
    cells_ = first_.back();
    first_.resize(first_.size() + DirectionGridView::kPadding);
    columns_.resize(columns_.size() + DirectionGridView::kPadding);
  }

  std::size_t rows() const { return least_cosine_.size(); }
  std::size_t cells() const { return cells_; }
  std::uint32_t first_cell(std::size_t row) const { return first_[row]; }
  std::uint32_t columns(std::size_t row) const { return first_[row + 1] - first_[row]; }
  DirectionGridView view() const {
    return {.low_rad = static_cast<float>(low_rad_),
            .rows_per_rad = static_cast<float>(1.0 / cell_rad_),
            .rows = static_cast<std::int32_t>(rows()),
            .cell_rad = static_cast<float>(cell_rad_),
            .columns = columns_.data(),
            .first = first_.data()};
  }
  double cell_rad() const { return cell_rad_; }
  double row_bottom_rad(std::size_t row) const { return low_rad_ + static_cast<double>(row) * cell_rad_; }
  /// Bounds of the cosines of the elevations in the row; never negative.
  double least_cosine(std::size_t row) const { return least_cosine_[row]; }
  double greatest_cosine(std::size_t row) const { return greatest_cosine_[row]; }

  /// The row of an elevation as a real number: row r covers r to r + 1. May lie outside 0..rows().
  double row_coordinate(double elevation_rad) const { return (elevation_rad - low_rad_) / cell_rad_; }
  /// The column of an azimuth as a real number, 0..columns(row).
  double column_coordinate(std::size_t row, double azimuth_rad) const {
    return (azimuth_rad / (2.0 * std::numbers::pi) + 0.5) * columns(row);
  }

  std::size_t row_of(double elevation_rad) const {
    const double row = std::clamp(row_coordinate(elevation_rad), 0.0, static_cast<double>(rows() - 1));
    return static_cast<std::size_t>(row);
  }
  std::uint32_t cell_of(const Direction& direction) const {
    const std::size_t row = row_of(direction.elevation_rad);
    const auto column = static_cast<std::uint32_t>(std::max(0.0, column_coordinate(row, direction.azimuth_rad)));
    return first_[row] + std::min(column, columns(row) - 1);
  }

 private:
  static constexpr double kCosineMargin = 2e-7;  ///< keeps bounds in single precision bounds

  double low_rad_ = 0.0;
  double cell_rad_ = 1.0;
  std::vector<float> least_cosine_, greatest_cosine_;
  std::vector<float> columns_;        ///< one a row, and padding
  std::vector<std::uint32_t> first_;  ///< first cell of each row, the number of cells, and padding
  std::size_t cells_ = 0;
};

}  // namespace raywatch
