#include "core/elevation_model.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/cell_moments.hpp"
#include "core/passing_rays.hpp"

namespace raywatch {
namespace {

template <class Visit>
void for_each_usable(const ScanView& scan, Visit visit) {
  const Eigen::Matrix3d rotation = scan.world_from_sensor.orientation.toRotationMatrix();
  const UsableRange& usable = scan.index.usable();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3d in_sensor_m = scan.points[i].cast<double>();
    if (!is_usable(in_sensor_m.norm(), usable)) continue;
    visit(Eigen::Vector3d(rotation * in_sensor_m + scan.world_from_sensor.position_m));
  }
}

/// The farthest corner of the grid from a place.
double reach_to(const GridLayout& layout, const Eigen::Vector2d& place_m) {
  const Eigen::Vector2d size_m = layout.cell_m * Eigen::Vector2d(layout.columns, layout.rows);
  const Eigen::Vector2d low_m = (layout.origin_m - place_m).cwiseAbs();
  return low_m.cwiseMax((layout.origin_m + size_m - place_m).cwiseAbs()).norm();
}

/// A plane's slope and what is known of the spread around it.
struct Ground {
  Eigen::Vector2d slope;
  Eigen::Matrix2d slope_covariance;
  double variance_m2;
  double bend;  ///< how far the slope is from that of the cells around
};

class Modeller {
 public:
  Modeller(const EpochScans& epoch, const GridLayout& layout, const ElevationParameters& parameters)
      : epoch_(epoch), layout_(layout), parameters_(parameters) {}

  ElevationModel run() {
    model_.layout = layout_;
    model_.cells.resize(layout_.cell_count());
    gather();
    each_cell([&](std::size_t cell) { model_.cells[cell] = estimate(cell); });
    if (parameters_.height == CellHeight::median) take_medians();
    lower_ceilings();
    return std::move(model_);
  }

 private:
  using Grid = std::vector<CellSums>;

  template <class Visit>
  void each_cell(Visit visit) const {
    constexpr std::size_t kGrain = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, layout_.cell_count(), kGrain), [&](const auto& block) {
      for (std::size_t cell = block.begin(); cell < block.end(); ++cell) visit(cell);
    });
  }

  /// The sums of each scan; then of each station, and of all. One scan is summed in its own order, whichever thread
  /// does it.
  void gather() {
    std::vector<Grid> of_scan(epoch_.scans.size());
    tbb::parallel_for(std::size_t{0}, of_scan.size(), [&](std::size_t k) { of_scan[k] = sums_of(epoch_.scans[k]); });
    total_.resize(layout_.cell_count());
    for (std::size_t k = 0; k < of_scan.size(); ++k) {
      std::vector<float>& share = model_.stations[station_of(k)].share;
      each_cell([&](std::size_t cell) {
        share[cell] += static_cast<float>(of_scan[k][cell].moments.n);
        total_[cell].add(of_scan[k][cell]);
      });
    }
    for (ElevationStation& station : model_.stations) {
      each_cell([&](std::size_t cell) {
        const double n = total_[cell].moments.n;
        if (n > 0.0) station.share[cell] /= static_cast<float>(n);
      });
    }
  }

  Grid sums_of(const ScanView& scan) const {
    Grid sums(layout_.cell_count());
    for_each_usable(scan, [&](const Eigen::Vector3d& p) {
      const std::optional<std::size_t> cell = layout_.cell_at(p.x(), p.y());
      if (!cell) return;
      const Eigen::Vector2d center_m = layout_.center_m(*cell);
      sums[*cell].add({p.x() - center_m.x(), p.y() - center_m.y(), p.z()});
    });
    return sums;
  }

  /// The place, in the model, of the station of a scan; the station with the scan's pose if it is new.
  std::size_t station_of(std::size_t scan) {
    const auto found = std::find(numbers_.begin(), numbers_.end(), epoch_.stations[scan]);
    if (found != numbers_.end()) return static_cast<std::size_t>(found - numbers_.begin());
    numbers_.push_back(epoch_.stations[scan]);
    const ScanView& view = epoch_.scans[scan];
    noises_m_.push_back(view.sensor.range_noise_m.value_or(0.0));
    model_.stations.push_back(
        {view.world_from_sensor.position_m, view.pose_uncertainty, std::vector<float>(layout_.cell_count(), 0.0f)});
    return model_.stations.size() - 1;
  }

  CellMoments around(std::size_t cell) const {
    CellMoments sum;
    const auto column = static_cast<std::int64_t>(cell % layout_.columns);
    const auto row = static_cast<std::int64_t>(cell / layout_.columns);
    for (std::int64_t j = std::max<std::int64_t>(row - 1, 0); j <= std::min<std::int64_t>(row + 1, layout_.rows - 1);
         ++j) {
      for (std::int64_t i = std::max<std::int64_t>(column - 1, 0);
           i <= std::min<std::int64_t>(column + 1, layout_.columns - 1); ++i) {
        const auto steps = Eigen::Vector2d(static_cast<double>(i - column), static_cast<double>(j - row));
        sum.add(total_[static_cast<std::size_t>(j) * layout_.columns + static_cast<std::size_t>(i)].moments,
                layout_.cell_m * steps);
      }
    }
    return sum;
  }

  /// From the cell's own returns where they are many and spread, else from its neighbourhood; nothing where not even
  /// that shows a slope.
  std::optional<Ground> ground_at(std::size_t cell) const {
    constexpr double kEnough = 8.0, kFewest = 6.0;
    const CellMoments& own = total_[cell].moments;
    if (own.n >= kEnough && spreads(own, layout_.cell_m)) {
      const PlaneFit fit = fit_plane(own);
      // What the slope of the cell is known to be off by is no bend.
      const double bend2 = (fit_plane(around(cell)).slope - fit.slope).squaredNorm() - fit.slope_covariance.trace();
      return Ground{fit.slope, fit.slope_covariance, fit.variance_m2, std::sqrt(std::max(0.0, bend2))};
    }
    const CellMoments wide = around(cell);
    if (wide.n < kFewest || !spreads(wide, layout_.cell_m)) return std::nullopt;
    const PlaneFit fit = fit_plane(wide);
    // The cell's own spread counts as much as the neighbourhood's when it has as many returns as a plane has unknowns.
    constexpr double kPrior = 3.0;
    const double own_m2 = residual_m2(own, fit.slope);
    return Ground{fit.slope, fit.slope_covariance,
                  (own_m2 + kPrior * fit.variance_m2) / (std::max(own.n - 1.0, 0.0) + kPrior), 0.0};
  }

  ElevationCell estimate(std::size_t cell) const {
    const CellSums& own = total_[cell];
    ElevationCell result{.count = static_cast<std::uint32_t>(own.moments.n)};
    const auto quarters =
        std::ranges::count_if(own.quarters, [](const QuarterSum& quarter) { return quarter.n > 0.0; });
    if (quarters < parameters_.least_quarters) return result;
    const std::optional<Ground> ground = ground_at(cell);
    if (!ground) return result;
    result.slope = ground->slope;
    result.spread_m = std::sqrt(ground->variance_m2);
    average_quarters(own, static_cast<double>(quarters), cell, *ground, result);
    return result;
  }

  /// The mean of the heights of the quarters that hold returns, each brought to the middle of its own quarter; and then
  /// all together, if some hold none, to the middle of the cell.
  ///
  /// Its variance: the noise of the ranges averages out over returns. What else the returns scatter by is the shape of
  /// the ground, which returns that lie close together show in one and the same way, so that more of them do not help.
  /// And where a quarter's returns do not lie around its middle, the slope may be another there: by as much as it is
  /// another than that of the cells around.
  void average_quarters(const CellSums& own, double quarters, std::size_t cell, const Ground& ground,
                        ElevationCell& result) const {
    // Calibrated on simulated pits: tests/evaluate/VOLUMES.md.
    constexpr double kShapesOfQuarter = 1.5, kBendShare = 0.6;
    const double noise_m2 = std::min(noise_m2_of(cell, ground.slope), ground.variance_m2);
    const double shape_m2 = (ground.variance_m2 - noise_m2) / kShapesOfQuarter;
    double height_m = 0.0, variance_m2 = 0.0;
    Eigen::Vector2d offset_m = Eigen::Vector2d::Zero();
    for (std::size_t q = 0; q < own.quarters.size(); ++q) {
      const QuarterSum& quarter = own.quarters[q];
      if (quarter.n == 0.0) continue;
      const Eigen::Vector3d mean_m = quarter.sum / quarter.n;
      height_m += mean_m.z() / quarters;
      offset_m += mean_m.head<2>() / quarters;
      const double bent_m = kBendShare * ground.bend * (mean_m.head<2>() - middle_of_quarter_m(q)).norm();
      variance_m2 += (noise_m2 / quarter.n + shape_m2 + bent_m * bent_m) / (quarters * quarters);
    }
    result.height_m = height_m - even_slope(own, ground).dot(offset_m);
    result.sigma_m = std::sqrt(variance_m2 + offset_m.dot(ground.slope_covariance * offset_m));
  }

  Eigen::Vector2d middle_of_quarter_m(std::size_t quarter) const {
    return 0.25 * layout_.cell_m * Eigen::Vector2d(quarter % 2 == 0 ? -1.0 : 1.0, quarter < 2 ? -1.0 : 1.0);
  }

  /// The slope of the plane through the means of the quarters: of a cell that lies across the foot of a face, the face
  /// has most returns, but only its share of the area counts.
  Eigen::Vector2d even_slope(const CellSums& own, const Ground& ground) const {
    CellMoments means;
    for (const QuarterSum& quarter : own.quarters) {
      if (quarter.n > 0.0) means.add(quarter.sum / quarter.n);
    }
    return means.n == 4.0 && spreads(means, layout_.cell_m) ? fit_plane(means).slope : ground.slope;
  }

  /// The variance of a height that the noise of the ranges causes, on ground of that slope.
  double noise_m2_of(std::size_t cell, const Eigen::Vector2d& slope) const {
    const Eigen::Vector2d center_m = layout_.center_m(cell);
    const Eigen::Vector3d up(-slope.x(), -slope.y(), 1.0);
    const double height_m = total_[cell].moments.mean().z();
    double sum_m2 = 0.0;
    for (std::size_t k = 0; k < model_.stations.size(); ++k) {
      const ElevationStation& from = model_.stations[k];
      const Eigen::Vector3d ray_m = Eigen::Vector3d(center_m.x(), center_m.y(), height_m) - from.position_m;
      const double noise_m = noises_m_[k] * up.dot(ray_m) / ray_m.norm();
      sum_m2 += from.share[cell] * noise_m * noise_m;
    }
    return sum_m2;
  }

  /// Replaces the mean by the median of the heights, each brought to the middle of the cell along the slope. Its
  /// standard error is that of the mean times sqrt(pi / 2), for normal errors.
  void take_medians() {
    std::vector<std::size_t> first(layout_.cell_count() + 1, 0);
    for (std::size_t cell = 0; cell < layout_.cell_count(); ++cell) {
      first[cell + 1] = first[cell] + model_.cells[cell].count;
    }
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    std::vector<double> heights_m(first.back());
    for (const ScanView& scan : epoch_.scans) {
      for_each_usable(scan, [&](const Eigen::Vector3d& p) {
        const std::optional<std::size_t> cell = layout_.cell_at(p.x(), p.y());
        if (!cell) return;
        const Eigen::Vector2d& slope = model_.cells[*cell].slope;
        heights_m[next[*cell]++] = p.z() - slope.dot(p.head<2>() - layout_.center_m(*cell));
      });
    }
    each_cell([&](std::size_t i) {
      ElevationCell& cell = model_.cells[i];
      if (!cell.seen()) return;
      const auto begin = heights_m.begin() + static_cast<std::ptrdiff_t>(first[i]);
      const auto end = heights_m.begin() + static_cast<std::ptrdiff_t>(first[i + 1]);
      const auto middle = begin + (end - begin) / 2;
      std::nth_element(begin, middle, end);
      const bool even = (end - begin) % 2 == 0;
      cell.height_m = even ? 0.5 * (*middle + *std::max_element(begin, middle)) : *middle;
      cell.sigma_m *= std::sqrt(0.5 * 3.14159265358979323846);
    });
  }

  void lower_ceilings() {
    constexpr double kSigmas = 3.0;
    for (const ScanView& scan : epoch_.scans) {
      const Eigen::Vector2d position_m = scan.world_from_sensor.position_m.head<2>();
      const PassingRays rays(scan, {.step_m = layout_.cell_m, .reach_m = reach_to(layout_, position_m)});
      each_cell([&](std::size_t cell) {
        const Eigen::Vector2d center_m = layout_.center_m(cell);
        const double swing_m = (center_m - position_m).norm() * scan.pose_uncertainty.angle_rad;
        const double margin_m = kSigmas * std::hypot(scan.pose_uncertainty.position_m, swing_m);
        double& ceiling_m = model_.cells[cell].ceiling_m;
        ceiling_m = std::min(ceiling_m, rays.ceiling_m(center_m, layout_.cell_m) + margin_m);
      });
    }
  }

  const EpochScans& epoch_;
  const GridLayout& layout_;
  const ElevationParameters& parameters_;
  std::vector<std::uint32_t> numbers_;  ///< of the stations
  std::vector<double> noises_m_;        ///< the same: of the ranges; 0: not known
  Grid total_;
  ElevationModel model_;
};

}  // namespace

ElevationModel make_elevation_model(const EpochScans& epoch, const GridLayout& layout,
                                    const ElevationParameters& parameters) {
  return Modeller(epoch, layout, parameters).run();
}

HeightLeverage leverage_of(const ElevationModel& model, std::size_t station, std::size_t cell) {
  const ElevationCell& at = model.cells[cell];
  const ElevationStation& from = model.stations[station];
  const Eigen::Vector2d center_m = model.layout.center_m(cell);
  const Eigen::Vector3d up(-at.slope.x(), -at.slope.y(), 1.0);
  const Eigen::Vector3d arm_m = Eigen::Vector3d(center_m.x(), center_m.y(), at.height_m) - from.position_m;
  return HeightLeverage{up, arm_m.cross(up)}.scaled(from.share[cell]);
}

double pose_variance_m2(const ElevationModel& model, std::size_t cell) {
  double sum = 0.0;
  for (std::size_t k = 0; k < model.stations.size(); ++k) {
    sum += leverage_of(model, k, cell).variance(model.stations[k].uncertainty);
  }
  return sum;
}

std::vector<DifferenceCell> difference_of(const ElevationModel& before, const ElevationModel& after) {
  std::vector<DifferenceCell> cells(before.cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ElevationCell& earlier = before.cells[i];
    const ElevationCell& later = after.cells[i];
    if (!earlier.seen() || !later.seen()) continue;
    cells[i].rise_m = later.height_m - earlier.height_m;
    cells[i].random_sigma_m = std::hypot(earlier.sigma_m, later.sigma_m);
    const double poses_m2 = pose_variance_m2(before, i) + pose_variance_m2(after, i);
    cells[i].lod95_m = kTwoSided95 * std::sqrt(cells[i].random_sigma_m * cells[i].random_sigma_m + poses_m2);
  }
  return cells;
}

}  // namespace raywatch
