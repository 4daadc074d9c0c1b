#include "core/grid_layout.hpp"

#include "core/error.hpp"

namespace raywatch {

GridLayout layout_over(const Eigen::AlignedBox2d& area_m, double cell_m) {
  constexpr double kMostCells = 25e6;
  const char* const remedy = "must be above 0, and large enough for at most 25 million cells";
  if (!(cell_m > 0.0) || !std::isfinite(cell_m) || !area_m.sizes().allFinite()) {
    throw InvalidInput("The grid has no proper cells.", {{"cell_m", remedy}});
  }
  const Eigen::Array2d low = (area_m.min().array() / cell_m).floor(), high = (area_m.max().array() / cell_m).ceil();
  const Eigen::Array2d counts = (high - low).max(1.0);
  if (counts.prod() > kMostCells) throw InvalidInput("The grid has too many cells.", {{"cell_m", remedy}});
  return {.origin_m = low * cell_m,
          .cell_m = cell_m,
          .columns = static_cast<std::uint32_t>(counts.x()),
          .rows = static_cast<std::uint32_t>(counts.y())};
}

}  // namespace raywatch
