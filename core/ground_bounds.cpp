#include "core/ground_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace raywatch {
namespace {

HeightBounds own_bounds(const ElevationModel& model, std::size_t cell, const Prism& prism) {
  const auto inside = [&](double height_m) { return std::clamp(height_m, prism.z_min_m, prism.z_max_m); };
  const ElevationCell& at = model.cells[cell];
  if (!at.seen()) return {prism.z_min_m, inside(at.ceiling_m)};
  const double reach_m = kTwoSided95 * std::sqrt(at.sigma_m * at.sigma_m + pose_variance_m2(model, cell));
  return {inside(at.height_m - reach_m), inside(at.height_m + reach_m)};
}

/// Carries bounds from cell to cell: one pass in the order of the cells, one against it. By steps along sides and
/// diagonals a way is never shorter than the straight one, so that the bounds are never too narrow.
class Carrying {
 public:
  Carrying(const GridLayout& layout, double slope, std::vector<HeightBounds>& bounds)
      : columns_(layout.columns), rows_(layout.rows), step_m_(slope * layout.cell_m), bounds_(bounds) {}

  void run() {
    for (std::int64_t row = 0; row < rows_; ++row) {
      for (std::int64_t column = 0; column < columns_; ++column) take(column, row, -1);
    }
    for (std::int64_t row = rows_ - 1; row >= 0; --row) {
      for (std::int64_t column = columns_ - 1; column >= 0; --column) take(column, row, 1);
    }
  }

 private:
  /// From the four neighbours on one side, which were visited before.
  void take(std::int64_t column, std::int64_t row, std::int64_t side) {
    HeightBounds& to = bounds_[static_cast<std::size_t>(row * columns_ + column)];
    const auto from = [&](std::int64_t i, std::int64_t j, double rise_m) {
      if (i < 0 || j < 0 || i >= columns_ || j >= rows_) return;
      const HeightBounds& other = bounds_[static_cast<std::size_t>(j * columns_ + i)];
      to.low_m = std::max(to.low_m, other.low_m - rise_m);
      to.high_m = std::min(to.high_m, other.high_m + rise_m);
    };
    from(column + side, row, step_m_);
    from(column, row + side, step_m_);
    from(column + side, row + side, step_m_ * std::numbers::sqrt2);
    from(column - side, row + side, step_m_ * std::numbers::sqrt2);
  }

  std::int64_t columns_, rows_;
  double step_m_;
  std::vector<HeightBounds>& bounds_;
};

}  // namespace

std::vector<HeightBounds> ground_bounds(const ElevationModel& model, const Prism& prism,
                                        const GroundSteepness& steepness) {
  std::vector<HeightBounds> bounds(model.cells.size());
  for (std::size_t cell = 0; cell < bounds.size(); ++cell) bounds[cell] = own_bounds(model, cell, prism);
  if (!steepness.greatest_slope) return bounds;
  if (!(*steepness.greatest_slope > 0.0)) {
    throw InvalidInput("The greatest slope of the ground is none.",
                       {{"greatest_slope", "must be above 0; 1 is 45 degrees"}});
  }
  std::vector<HeightBounds> carried = bounds;
  Carrying(model.layout, *steepness.greatest_slope, carried).run();
  for (std::size_t cell = 0; cell < bounds.size(); ++cell) {
    // Where the ground is steeper than stated, the bounds of its neighbours contradict each other: they say nothing.
    const bool holds = carried[cell].low_m <= carried[cell].high_m;
    if (!model.cells[cell].seen() && holds) bounds[cell] = carried[cell];
  }
  return bounds;
}

}  // namespace raywatch
