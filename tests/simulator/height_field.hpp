#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "tests/simulator/ray.hpp"

namespace raywatch::simulator {

/// Where the nodes of a height field stand: node (column, row) at origin_m + cell_m * (column, row).
struct FieldLayout {
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();
  double cell_m = 1.0;
  std::uint32_t columns = 2;  ///< nodes along x, at least 2
  std::uint32_t rows = 2;     ///< nodes along y, at least 2

  Eigen::Vector2d node_m(std::uint32_t column, std::uint32_t row) const {
    return origin_m + cell_m * Eigen::Vector2d(column, row);
  }
  std::size_t node_count() const { return std::size_t{columns} * rows; }
  std::size_t cell_count() const { return std::size_t{columns - 1} * (rows - 1); }
};

/// A state for every cell of a field, row by row, (columns - 1) * (rows - 1) of them.
using CellStates = std::vector<std::uint16_t>;

/// The surface z = h(x, y), bilinear within each cell, so that heights, volumes and ranges are all known exactly.
/// Immutable. Rays are traced through a pyramid of lowest and highest heights.
class HeightField {
 public:
  /// `heights_m` holds one height per node, row by row.
  HeightField(const FieldLayout& layout, std::vector<double> heights_m);
  /// Samples a function at the nodes.
  HeightField(const FieldLayout& layout, const std::function<double(const Eigen::Vector2d&)>& height_m);

  const FieldLayout& layout() const { return layout_; }
  const std::vector<double>& heights_m() const { return heights_m_; }
  double lowest_m() const { return levels_.back().lowest_m.front(); }
  double highest_m() const { return levels_.back().highest_m.front(); }

  /// The height at a place; outside the field that of the nearest place on its border.
  double height_m(const Eigen::Vector2d& place_m) const;
  /// The row-major index of the cell at a place, clamped to the field.
  std::size_t cell_at(const Eigen::Vector2d& place_m) const;
  /// The upward unit normal at a place.
  Eigen::Vector3d normal(const Eigen::Vector2d& place_m) const;

  std::optional<double> intersect(const Ray& ray) const;

 private:
  struct Level {
    std::uint32_t columns, rows;
    std::vector<double> lowest_m, highest_m;
  };
  struct Patch;
  struct CellRay;
  /// A part of a ray, as distances along it.
  struct Stretch {
    double from;
    double to;
  };

  void build_pyramid();
  /// Where the ray is above or below the field's area and within its heights.
  Stretch stretch_within(const CellRay& ray) const;
  static bool may_hit(const CellRay& ray, const Stretch& part, const Level& level, std::size_t block);
  std::optional<double> hit_in_cell(const CellRay& ray, const Stretch& part, std::uint32_t column,
                                    std::uint32_t row) const;
  double node_height_m(std::uint32_t column, std::uint32_t row) const {
    return heights_m_[std::size_t{row} * layout_.columns + column];
  }

  FieldLayout layout_;
  std::vector<double> heights_m_;
  std::vector<Level> levels_;  ///< 0: single cells; each next one has blocks of 2 x 2
};

/// The mean height over a rectangle inside the field, exactly: over any rectangle, a bilinear function has the mean
/// that it has in the middle.
double mean_height_m(const HeightField& field, const Eigen::AlignedBox2d& area_m);

/// What lies between two fields of one layout. Positive numbers.
struct VolumeChange {
  double filled_m3 = 0.0;  ///< where `after` is higher
  double cut_m3 = 0.0;     ///< where it is lower
};

/// Exact for cells that are filled or cut as a whole; a cell that is partly both is integrated numerically.
VolumeChange volume_change(const HeightField& before, const HeightField& after);

}  // namespace raywatch::simulator
