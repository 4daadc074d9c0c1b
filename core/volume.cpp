#include "core/volume.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace raywatch {
namespace {

/// The share of a cell's area that lies inside a polygon, on a lattice.
double share_of_cell(const Prism& prism, const GridLayout& layout, std::size_t cell) {
  constexpr int kSteps = 8;
  const Eigen::Vector2d center_m = layout.center_m(cell);
  int inside = 0;
  for (int k = 0; k < kSteps * kSteps; ++k) {
    const Eigen::Array2d step(k % kSteps, k / kSteps);
    const Eigen::Vector2d at_m = center_m.array() + layout.cell_m * ((step + 0.5) / kSteps - 0.5);
    inside += contains(prism, {at_m.x(), at_m.y(), prism.z_min_m}) ? 1 : 0;
  }
  return inside / static_cast<double>(kSteps * kSteps);
}

/// Sums one volume over cells, and what its errors come of.
class VolumeSum {
 public:
  VolumeSum(const ElevationModel& before, const ElevationModel& after)
      : models_{&before, &after},
        leverages_{std::vector<HeightLeverage>(before.stations.size()),
                   std::vector<HeightLeverage>(after.stations.size())} {}

  /// Adds a cell of which `area_m2` counts. A height that is cut off at an end of the prism has no error.
  struct Part {
    std::size_t cell;
    double area_m2;
    double rise_m;
    bool free_before = true;
    bool free_after = true;
  };
  void add(const Part& part) {
    value_m3_ += part.area_m2 * part.rise_m;
    const bool free[2] = {part.free_before, part.free_after};
    for (std::size_t e = 0; e < 2; ++e) {
      if (!free[e]) continue;
      const double sigma_m3 = part.area_m2 * models_[e]->cells[part.cell].sigma_m;
      random_m6_ += sigma_m3 * sigma_m3;
      for (std::size_t k = 0; k < leverages_[e].size(); ++k) {
        leverages_[e][k] += leverage_of(*models_[e], k, part.cell).scaled(part.area_m2);
      }
    }
  }
  VolumeFigure figure() const {
    double pose_m6 = 0.0;
    for (std::size_t e = 0; e < 2; ++e) {
      for (std::size_t k = 0; k < leverages_[e].size(); ++k) {
        pose_m6 += leverages_[e][k].variance(models_[e]->stations[k].uncertainty);
      }
    }
    return {value_m3_, std::sqrt(random_m6_), std::sqrt(pose_m6)};
  }

 private:
  const ElevationModel* models_[2];
  std::vector<HeightLeverage> leverages_[2];  ///< by epoch and station
  double value_m3_ = 0.0;
  double random_m6_ = 0.0;
};

/// The heights between which the ground of a cell lies.
struct Between {
  double low_m;
  double high_m;
};

Between ground_of(const ElevationCell& cell, const Prism& prism) {
  const auto inside = [&](double height_m) { return std::clamp(height_m, prism.z_min_m, prism.z_max_m); };
  if (cell.seen()) {
    const double reach_m = 1.96 * cell.sigma_m;
    return {inside(cell.height_m - reach_m), inside(cell.height_m + reach_m)};
  }
  return {prism.z_min_m, inside(cell.ceiling_m)};
}

/// One zone's figures while cells are added.
class ZoneSum {
 public:
  ZoneSum(const ElevationModel& before, const ElevationModel& after, const Prism& prism)
      : before_(before),
        after_(after),
        prism_(prism),
        cut_(before, after),
        fill_(before, after),
        changed_(before, after),
        net_(before, after) {}

  /// @param beside whether the cell or one beside it surely changed.
  void add(std::size_t cell, const DifferenceCell& difference, bool beside, double area_m2) {
    sums_.area_m2 += area_m2;
    if (difference.seen()) {
      add_seen(cell, difference, beside, area_m2);
    } else {
      const Between earlier = ground_of(before_.cells[cell], prism_), later = ground_of(after_.cells[cell], prism_);
      sums_.unseen += VolumeBounds{area_m2 * (later.low_m - earlier.high_m), area_m2 * (later.high_m - earlier.low_m)};
    }
  }

  ZoneVolumes result() {
    const double area_m2 = sums_.changed_area_m2;
    if (area_m2 > 0.0) {
      sums_.vertical.mean_m /= area_m2;
      sums_.normal.mean_m /= area_m2;
    }
    sums_.cut = cut_.figure();
    sums_.cut.value_m3 = std::abs(sums_.cut.value_m3);
    sums_.fill = fill_.figure();
    sums_.changed_net = changed_.figure();
    sums_.net = net_.figure();
    return sums_;
  }

 private:
  void add_seen(std::size_t cell, const DifferenceCell& difference, bool beside, double area_m2) {
    const double from_m = before_.cells[cell].height_m, to_m = after_.cells[cell].height_m;
    const double low_m = prism_.z_min_m, high_m = prism_.z_max_m;
    const VolumeSum::Part part{
        .cell = cell,
        .area_m2 = area_m2,
        .rise_m = std::clamp(to_m, low_m, high_m) - std::clamp(from_m, low_m, high_m),
        .free_before = from_m > low_m && from_m<high_m, .free_after = to_m> low_m && to_m < high_m};
    sums_.seen_area_m2 += area_m2;
    net_.add(part);
    if (!beside || part.rise_m == 0.0) return;
    changed_.add(part);
    (part.rise_m > 0.0 ? fill_ : cut_).add(part);
    if (!difference.changed()) return;
    sums_.changed_area_m2 += area_m2;
    extend(sums_.vertical, part.rise_m, area_m2);
    extend(sums_.normal, part.rise_m / std::sqrt(1.0 + before_.cells[cell].slope.squaredNorm()), area_m2);
  }

  static void extend(ChangeExtent& extent, double change_m, double area_m2) {
    extent.greatest_rise_m = std::max(extent.greatest_rise_m, change_m);
    extent.greatest_fall_m = std::min(extent.greatest_fall_m, change_m);
    extent.mean_m += area_m2 * change_m;
  }

  const ElevationModel& before_;
  const ElevationModel& after_;
  const Prism& prism_;
  VolumeSum cut_, fill_, changed_, net_;
  ZoneVolumes sums_;
};

/// One a cell: whether it or one of its eight neighbours surely changed.
std::vector<std::uint8_t> beside_changes(const GridLayout& layout, std::span<const DifferenceCell> difference) {
  std::vector<std::uint8_t> beside(difference.size(), 0);
  const std::size_t columns = layout.columns, rows = layout.rows;
  for (std::size_t cell = 0; cell < difference.size(); ++cell) {
    if (!difference[cell].changed()) continue;
    const std::size_t column = cell % columns, row = cell / columns;
    for (std::size_t j = row - std::min<std::size_t>(row, 1); j <= std::min(row + 1, rows - 1); ++j) {
      for (std::size_t i = column - std::min<std::size_t>(column, 1); i <= std::min(column + 1, columns - 1); ++i) {
        beside[j * columns + i] = 1;
      }
    }
  }
  return beside;
}

void check_layouts(const ElevationModel& before, const ElevationModel& after) {
  if (!(before.layout == after.layout)) {
    throw InvalidInput("The two elevation models have different grids; make both over one area with one cell size.");
  }
}

}  // namespace

ZoneVolumes volumes_between(const ElevationModel& before, const ElevationModel& after, const Prism& prism) {
  check_layouts(before, after);
  const std::vector<DifferenceCell> difference = difference_of(before, after);
  const std::vector<std::uint8_t> beside = beside_changes(before.layout, difference);
  ZoneSum sum(before, after, prism);
  for (std::size_t cell = 0; cell < difference.size(); ++cell) {
    const double share = share_of_cell(prism, before.layout, cell);
    if (share > 0.0) sum.add(cell, difference[cell], beside[cell] != 0, share * before.layout.cell_area_m2());
  }
  return sum.result();
}

FootprintVolume volume_over(const ElevationModel& before, const ElevationModel& after,
                            std::span<const std::size_t> cells) {
  check_layouts(before, after);
  FootprintVolume result;
  VolumeSum sum(before, after);
  const double area_m2 = before.layout.cell_area_m2();
  for (const std::size_t cell : cells) {
    result.area_m2 += area_m2;
    if (!before.cells[cell].seen() || !after.cells[cell].seen()) continue;
    result.seen_area_m2 += area_m2;
    sum.add({.cell = cell, .area_m2 = area_m2, .rise_m = after.cells[cell].height_m - before.cells[cell].height_m});
  }
  result.net = sum.figure();
  return result;
}

MassFigure mass_of(const VolumeFigure& volume, double density_t_per_m3) {
  if (!(density_t_per_m3 > 0.0)) {
    throw InvalidInput("The density is not one.", {{"density_t_per_m3", "must be above 0"}});
  }
  return {density_t_per_m3 * volume.value_m3, density_t_per_m3 * volume.low_m3(), density_t_per_m3 * volume.high_m3()};
}

}  // namespace raywatch
