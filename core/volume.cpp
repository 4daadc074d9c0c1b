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
  /// Without what the errors of the poses, as far as they are known, make of it.
  VolumeFigure figure(const PoseErrors& poses) const {
    const PoseLeverage leverage = poses.leverage_of(leverages_[0], leverages_[1]);
    return {value_m3_ - poses.rise(leverage), std::sqrt(random_m6_), std::sqrt(poses.variance(leverage))};
  }

 private:
  const ElevationModel* models_[2];
  std::vector<HeightLeverage> leverages_[2];  ///< by epoch and station
  double value_m3_ = 0.0;
  double random_m6_ = 0.0;
};

/// One zone's figures while cells are added.
class ZoneSum {
 public:
  ZoneSum(const ElevationModel& before, const ElevationModel& after, const ChangedGround& ground, const Prism& prism,
          const GroundSteepness& steepness)
      : before_(before),
        after_(after),
        prism_(prism),
        ground_(ground),
        earlier_(ground_bounds(before, prism, steepness)),
        later_(ground_bounds(after, prism, steepness)),
        cut_(before, after),
        fill_(before, after),
        changed_(before, after),
        net_(before, after) {}

  void add(std::size_t cell, double area_m2) {
    sums_.area_m2 += area_m2;
    if (before_.cells[cell].seen() && after_.cells[cell].seen()) {
      add_seen(cell, area_m2);
    } else {
      const HeightBounds earlier = earlier_[cell], later = later_[cell];
      sums_.unseen += VolumeBounds{area_m2 * (later.low_m - earlier.high_m), area_m2 * (later.high_m - earlier.low_m)};
    }
  }

  ZoneVolumes result() {
    const double area_m2 = sums_.changed_area_m2;
    if (area_m2 > 0.0) {
      sums_.vertical.mean_m /= area_m2;
      sums_.normal.mean_m /= area_m2;
    }
    sums_.cut = cut_.figure(ground_.poses);
    sums_.cut.value_m3 = 0.0 - sums_.cut.value_m3;
    sums_.fill = fill_.figure(ground_.poses);
    sums_.changed_net = changed_.figure(ground_.poses);
    sums_.net = net_.figure(PoseErrors(before_, after_));
    return sums_;
  }

 private:
  void add_seen(std::size_t cell, double area_m2) {
    const double from_m = before_.cells[cell].height_m, to_m = after_.cells[cell].height_m;
    const double low_m = prism_.z_min_m, high_m = prism_.z_max_m;
    const VolumeSum::Part part{
        .cell = cell,
        .area_m2 = area_m2,
        .rise_m = std::clamp(to_m, low_m, high_m) - std::clamp(from_m, low_m, high_m),
        .free_before = from_m > low_m && from_m<high_m, .free_after = to_m> low_m && to_m < high_m};
    sums_.seen_area_m2 += area_m2;
    net_.add(part);
    const ChangedCell& changed = ground_.cells[cell];
    if (changed.sign == 0 || part.rise_m == 0.0) return;
    changed_.add(part);
    (changed.sign > 0 ? fill_ : cut_).add(part);
    if (!changed.surely) return;
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
  const ChangedGround& ground_;
  std::vector<HeightBounds> earlier_, later_;
  VolumeSum cut_, fill_, changed_, net_;
  ZoneVolumes sums_;
};

void check_layouts(const ElevationModel& before, const ElevationModel& after) {
  if (!(before.layout == after.layout)) {
    throw InvalidInput("The two elevation models have different grids; make both over one area with one cell size.");
  }
}

}  // namespace

ZoneVolumes volumes_between(const ElevationModel& before, const ElevationModel& after, const Prism& prism,
                            const GroundSteepness& steepness) {
  check_layouts(before, after);
  return volumes_between(before, after, changed_ground(before, after), prism, steepness);
}

ZoneVolumes volumes_between(const ElevationModel& before, const ElevationModel& after, const ChangedGround& ground,
                            const Prism& prism, const GroundSteepness& steepness) {
  check_layouts(before, after);
  ZoneSum sum(before, after, ground, prism, steepness);
  for (std::size_t cell = 0; cell < before.cells.size(); ++cell) {
    const double share = share_of_cell(prism, before.layout, cell);
    if (share > 0.0) sum.add(cell, share * before.layout.cell_area_m2());
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
  result.net = sum.figure(PoseErrors(before, after));
  return result;
}

MassFigure mass_of(const VolumeFigure& volume, double density_t_per_m3) {
  if (!(density_t_per_m3 > 0.0)) {
    throw InvalidInput("The density is not one.", {{"density_t_per_m3", "must be above 0"}});
  }
  return {density_t_per_m3 * volume.value_m3, density_t_per_m3 * volume.low_m3(), density_t_per_m3 * volume.high_m3()};
}

}  // namespace raywatch
