#include "core/survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/survey_m3c2.hpp"

namespace raywatch {
namespace {

Eigen::AlignedBox2d area_of(std::span<const SurveyZone> zones) {
  Eigen::AlignedBox2d area_m;
  for (const SurveyZone& zone : zones) {
    for (const Eigen::Vector2d& corner : zone.prism.polygon_m) area_m.extend(corner);
  }
  return area_m;
}

Eigen::AlignedBox3d box_around(std::span<const SurveyZone> zones) {
  const Eigen::AlignedBox2d area_m = area_of(zones);
  double low_m = zones.front().prism.z_min_m, high_m = zones.front().prism.z_max_m;
  for (const SurveyZone& zone : zones) {
    low_m = std::min(low_m, zone.prism.z_min_m);
    high_m = std::max(high_m, zone.prism.z_max_m);
  }
  return {Eigen::Vector3d(area_m.min().x(), area_m.min().y(), low_m),
          Eigen::Vector3d(area_m.max().x(), area_m.max().y(), high_m)};
}

void add(VolumeFigure& sum, const VolumeFigure& part) {
  sum.value_m3 += part.value_m3;
  sum.random_sigma_m3 = std::hypot(sum.random_sigma_m3, part.random_sigma_m3);
  sum.pose_sigma_m3 += part.pose_sigma_m3;
}

/// Adds extents whose means are still multiplied by the changed area.
void add(ChangeExtent& sum, const ChangeExtent& part, double area_m2) {
  sum.greatest_rise_m = std::max(sum.greatest_rise_m, part.greatest_rise_m);
  sum.greatest_fall_m = std::min(sum.greatest_fall_m, part.greatest_fall_m);
  sum.mean_m += area_m2 * part.mean_m;
}

ZoneVolumes sum_of(std::span<const ZoneFigures> zones) {
  ZoneVolumes sum;
  for (const ZoneFigures& zone : zones) {
    const ZoneVolumes& part = zone.volumes;
    add(sum.cut, part.cut);
    add(sum.fill, part.fill);
    add(sum.changed_net, part.changed_net);
    add(sum.net, part.net);
    add(sum.vertical, part.vertical, part.changed_area_m2);
    add(sum.normal, part.normal, part.changed_area_m2);
    sum.area_m2 += part.area_m2;
    sum.seen_area_m2 += part.seen_area_m2;
    sum.changed_area_m2 += part.changed_area_m2;
    sum.unseen += part.unseen;
  }
  if (sum.changed_area_m2 > 0.0) {
    sum.vertical.mean_m /= sum.changed_area_m2;
    sum.normal.mean_m /= sum.changed_area_m2;
  }
  return sum;
}

std::optional<ZoneMasses> masses_of(const ZoneVolumes& volumes, const std::optional<double>& density_t_per_m3) {
  if (!density_t_per_m3) return std::nullopt;
  return ZoneMasses{mass_of(volumes.cut, *density_t_per_m3), mass_of(volumes.fill, *density_t_per_m3),
                    mass_of(volumes.net, *density_t_per_m3)};
}

GroundSteepness steepness_of(const SurveyDefinition& definition) {
  if (!definition.greatest_slope_deg) return {};
  return {.greatest_slope = std::tan(*definition.greatest_slope_deg * std::numbers::pi / 180.0)};
}

void measure_zones(const SurveyInput& input, std::span<const SurveyZone> zones, SurveyResult& result) {
  const std::vector<M3c2Figures> m3c2 = m3c2_of_zones(input, zones, result.registration_m);
  const std::optional<double>& density = input.definition.density_t_per_m3;
  const GroundSteepness steepness = steepness_of(input.definition);
  const ChangedGround ground = changed_ground(result.before_model, result.after_model);
  for (std::size_t z = 0; z < zones.size(); ++z) {
    ZoneFigures& figures = result.zones.emplace_back();
    figures.zone = zones[z];
    figures.volumes = volumes_between(result.before_model, result.after_model, ground, zones[z].prism, steepness);
    figures.m3c2 = m3c2[z];
    figures.masses = masses_of(figures.volumes, density);
  }
  result.total.zone.name = "total";
  result.total.volumes = sum_of(result.zones);
  result.total.m3c2 = m3c2.back();
  result.total.masses = masses_of(result.total.volumes, density);
}

std::vector<std::size_t> zones_with(std::span<const SurveyZone> zones, const OrientedBox& box) {
  std::vector<std::size_t> found;
  for (std::size_t z = 0; z < zones.size(); ++z) {
    if (share_inside(zones[z].prism, box) >= kShareInZone) found.push_back(z);
  }
  return found;
}

void find_changes(const SurveyInput& input, std::span<const SurveyZone> zones, SurveyResult& result) {
  const EpochPair epochs{input.before.scans, input.after.scans};
  EpochComparison comparison = compare_epochs(epochs, input.parameters);
  const std::vector<FootprintVolume> volumes =
      volumes_of_changes(epochs, comparison, result.before_model, result.after_model);
  for (std::size_t i = 0; i < comparison.changes.size(); ++i) {
    SurveyChange& change = result.changes.emplace_back();
    change.change = comparison.changes[i];
    change.volume = volumes[i];
    if (input.definition.density_t_per_m3) {
      change.mass = mass_of(volumes[i].net, *input.definition.density_t_per_m3);
    }
    change.zones = zones_with(zones, comparison.changes[i].box);
  }
  result.testable_before = comparison.testable_before;
  result.testable_after = comparison.testable_after;
  result.before_points = std::move(comparison.before);
  result.after_points = std::move(comparison.after);
  std::ranges::move(comparison.warnings, std::back_inserter(result.warnings));
}

/// Where all but the outermost thousandth of an epoch's returns lie, along each axis.
Eigen::AlignedBox3d extent_of(const EpochScans& epoch) {
  const double all_m = std::numeric_limits<double>::infinity();
  const PointCloud cloud =
      world_points_in(epoch, {Eigen::Vector3d::Constant(-all_m), Eigen::Vector3d::Constant(all_m)});
  if (cloud.empty()) throw InvalidInput("An epoch without usable returns cannot be surveyed.");
  Eigen::AlignedBox3d box_m;
  box_m.min().setZero();
  box_m.max().setZero();
  int axis = 0;
  for (std::vector<float> plane : {cloud.x_m, cloud.y_m, cloud.z_m}) {
    const auto outermost = static_cast<std::ptrdiff_t>(plane.size() / 1000);
    std::ranges::nth_element(plane, plane.begin() + outermost);
    box_m.min()[axis] = plane[static_cast<std::size_t>(outermost)];
    std::ranges::nth_element(plane, plane.end() - 1 - outermost);
    box_m.max()[axis++] = *(plane.end() - 1 - outermost);
  }
  return box_m;
}

/// Says which scans of the later epoch stand at their reported pose: their volumes have intervals that are too narrow.
void warn_of_poses(const SurveyEpoch& later, std::vector<std::string>& warnings) {
  for (const SurveyedScan& scan : later.about) {
    if (scan.uncertainty.position_m > 0.0 || scan.uncertainty.angle_rad > 0.0) continue;
    warnings.push_back("scan " + std::to_string(scan.scan.value) +
                       " was not fitted onto earlier ones; its pose is taken as exact, so that intervals are narrower "
                       "than they should be");
  }
}

}  // namespace

SurveyResult survey_between(const SurveyInput& input) {
  check_definition(input.definition);
  std::vector<SurveyZone> zones = input.zones;
  SurveyResult result;
  if (zones.empty()) {
    zones.push_back(whole_site(input.before.scans, input.after.scans));
    result.warnings.push_back(
        "no zone of kind \"volume\" was given: the whole site is surveyed, and the bounds of what was not seen rest on "
        "the lowest and highest returns");
  }
  result.definition = input.definition;
  result.parameters = input.parameters;
  result.program_version = input.program_version;
  result.before = input.before.about;
  result.after = input.after.about;
  warn_of_poses(input.after, result.warnings);

  const GridLayout layout = layout_over(area_of(zones), input.definition.cell_m);
  result.before_model = make_elevation_model(input.before.scans, layout, input.definition.elevation);
  result.after_model = make_elevation_model(input.after.scans, layout, input.definition.elevation);
  result.difference = difference_of(result.before_model, result.after_model);
  result.registration_m = registration_error_m(input.before.scans, input.after.scans, box_around(zones));
  measure_zones(input, zones, result);
  find_changes(input, zones, result);
  return result;
}

SurveyZone whole_site(const EpochScans& before, const EpochScans& after) {
  const Eigen::AlignedBox3d box_m = extent_of(before).intersection(extent_of(after));
  if (box_m.isEmpty() || (box_m.sizes().head<2>().array() <= 0.0).any()) {
    throw InvalidInput("The epochs have no place in common; choose epochs of one site, or draw a volume zone.");
  }
  const Eigen::Vector3d low_m = box_m.min(), high_m = box_m.max();
  return {.name = "whole site",
          .prism = {{low_m.head<2>(), {high_m.x(), low_m.y()}, high_m.head<2>(), {low_m.x(), high_m.y()}},
                    low_m.z() - 1.0,
                    high_m.z() + 1.0}};
}

std::optional<FigureValue> value_of(const ZoneFigures& figures, SurveyFigure figure) {
  const ZoneVolumes& volumes = figures.volumes;
  const auto of = [](const VolumeFigure& volume) {
    return FigureValue{volume.value_m3, volume.low_m3(), volume.high_m3()};
  };
  if (figure == SurveyFigure::seen_share) return FigureValue{volumes.seen_share()};
  if (!(volumes.seen_area_m2 > 0.0)) return std::nullopt;
  switch (figure) {
    case SurveyFigure::cut_m3:
      return of(volumes.cut);
    case SurveyFigure::fill_m3:
      return of(volumes.fill);
    case SurveyFigure::net_m3:
      return of(volumes.net);
    case SurveyFigure::changed_net_m3:
      return of(volumes.changed_net);
    case SurveyFigure::changed_area_m2:
      return FigureValue{volumes.changed_area_m2};
    case SurveyFigure::greatest_rise_m:
      return FigureValue{volumes.vertical.greatest_rise_m};
    case SurveyFigure::greatest_fall_m:
      return FigureValue{volumes.vertical.greatest_fall_m};
    case SurveyFigure::mean_change_m:
      return FigureValue{volumes.vertical.mean_m};
    case SurveyFigure::m3c2_greatest_m:
      return FigureValue{figures.m3c2.greatest_m()};
    case SurveyFigure::m3c2_mean_m:
      return FigureValue{figures.m3c2.mean_m};
    case SurveyFigure::seen_share:
      break;
  }
  return std::nullopt;
}

}  // namespace raywatch
