#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/grid_layout.hpp"

namespace raywatch {

/// The grid of a mine, beside the coordinates of its site: turned, stretched and moved, heights only moved.
struct MineGrid {
  Eigen::Vector3d site_origin_m = Eigen::Vector3d::Zero();  ///< a place in the site's coordinates ...
  Eigen::Vector3d grid_origin_m = Eigen::Vector3d::Zero();  ///< ... and the same place in the grid's
  double rotation_rad = 0.0;                                ///< of the site's axes in the grid, counter-clockwise
  double scale = 1.0;                                       ///< grid metres a site metre, horizontally
};

/// @throws InvalidInput naming every member that is not finite, a place beyond 1e9 m, or a scale that is not within
/// 0.9..1.1: a grid's scale is that of a projection, a few parts in ten thousand.
void check_grid(const MineGrid& grid);

/// In which coordinates results of a site go out. Inside, places are relative to the site's origin ("local").
struct OutputFrame {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< of the site: site = local + origin
  std::optional<int> epsg = {};                        ///< of the site's coordinates; not with a grid
  std::optional<MineGrid> grid = {};                   ///< results go out in it

  Eigen::Vector3d site_from_local(const Eigen::Vector3d& local_m) const { return local_m + origin_m; }
  Eigen::Vector3d output_from_local(const Eigen::Vector3d& local_m) const;
  Eigen::Vector3d local_from_output(const Eigen::Vector3d& output_m) const;
};

/// From columns and rows of a grid of cells, counted from its corner of least x and y in the order of its cells, to
/// output coordinates: corner_m + column * a_column_m + row * a_row_m.
struct CellTransform {
  Eigen::Vector2d corner_m, a_column_m, a_row_m;
};
CellTransform cell_transform(const GridLayout& layout, const OutputFrame& frame);

}  // namespace raywatch
