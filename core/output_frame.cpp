#include "core/output_frame.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.hpp"

namespace raywatch {

void check_grid(const MineGrid& grid) {
  // Beyond it doubles no longer tell millimetres well apart; all grids on Earth are far smaller.
  constexpr double kFarthest_m = 1e9;
  std::vector<FieldError> errors;
  const auto require_place = [&](const Eigen::Vector3d& place_m, const char* field) {
    if (!(place_m.array().abs() <= kFarthest_m).all()) errors.push_back({field, "must be three numbers within 1e9 m"});
  };
  require_place(grid.site_origin_m, "site_origin_m");
  require_place(grid.grid_origin_m, "grid_origin_m");
  if (!std::isfinite(grid.rotation_rad)) errors.push_back({"rotation_deg", "must be a number"});
  if (!(grid.scale >= 0.9 && grid.scale <= 1.1)) errors.push_back({"scale", "must be 0.9..1.1; 1 does not stretch"});
  if (!errors.empty()) throw InvalidInput("The mine grid is not one.", errors);
}

Eigen::Vector3d OutputFrame::output_from_local(const Eigen::Vector3d& local_m) const {
  const Eigen::Vector3d site_m = site_from_local(local_m);
  if (!grid) return site_m;
  Eigen::Vector3d from_origin_m = site_m - grid->site_origin_m;
  from_origin_m.head<2>() = grid->scale * (Eigen::Rotation2Dd(grid->rotation_rad) * from_origin_m.head<2>());
  return grid->grid_origin_m + from_origin_m;
}

Eigen::Vector3d OutputFrame::local_from_output(const Eigen::Vector3d& output_m) const {
  if (!grid) return output_m - origin_m;
  Eigen::Vector3d from_origin_m = output_m - grid->grid_origin_m;
  from_origin_m.head<2>() = Eigen::Rotation2Dd(-grid->rotation_rad) * from_origin_m.head<2>() / grid->scale;
  return grid->site_origin_m + from_origin_m - origin_m;
}

CellTransform cell_transform(const GridLayout& layout, const OutputFrame& frame) {
  const auto out_m = [&](double columns, double rows) {
    const Eigen::Vector2d local_m = layout.origin_m + layout.cell_m * Eigen::Vector2d(columns, rows);
    return Eigen::Vector2d(frame.output_from_local({local_m.x(), local_m.y(), 0.0}).head<2>());
  };
  // Steps over the whole grid, so that rounding of large coordinates does not add up.
  const Eigen::Vector2d corner_m = out_m(0.0, 0.0);
  return {.corner_m = corner_m,
          .a_column_m = (out_m(layout.columns, 0.0) - corner_m) / layout.columns,
          .a_row_m = (out_m(0.0, layout.rows) - corner_m) / layout.rows};
}

}  // namespace raywatch
