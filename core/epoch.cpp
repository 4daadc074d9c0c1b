#include "core/epoch.hpp"

#include <algorithm>
#include <array>

#include "core/choose_priors.hpp"
#include "core/detect_points.hpp"
#include "core/error.hpp"
#include "core/fold.hpp"

namespace raywatch {
namespace {

constexpr double kLeastOverlap = ChoiceParameters{}.min_overlap;

std::vector<Panorama> panoramas_of(const EpochScans& epoch) {
  std::vector<Panorama> panoramas;
  for (const ScanView& scan : epoch.scans) panoramas.push_back(make_panorama(scan.points, scan.index.usable()));
  return panoramas;
}

/// The scans of the other epoch that cover enough of a scan.
std::vector<ScanView> overlapping(const ScanView& scan, const EpochScans& other, std::span<const Panorama> coverage) {
  const std::vector<Eigen::Vector3d> sample_m =
      sample_world_points(scan.points, scan.world_from_sensor, scan.index.usable(), ChoiceParameters{}.sample_points);
  std::vector<ScanView> result;
  for (std::size_t k = 0; k < other.scans.size(); ++k) {
    const std::vector<std::uint8_t> inside = covered(coverage[k], other.scans[k].world_from_sensor.inverse(), sample_m);
    if (static_cast<double>(std::ranges::count(inside, 1)) >= kLeastOverlap * static_cast<double>(sample_m.size())) {
      result.push_back(other.scans[k]);
    }
  }
  return result;
}

void check(const EpochPair& epochs, Duration tolerance) {
  if (epochs.before.scans.empty() || epochs.after.scans.empty()) {
    throw InvalidInput("An epoch without scans cannot be compared.");
  }
  const auto by_time = [](const ScanView& a, const ScanView& b) { return a.captured_at < b.captured_at; };
  const auto last = std::ranges::max_element(epochs.before.scans, by_time);
  const auto first = std::ranges::min_element(epochs.after.scans, by_time);
  if (between(last->captured_at, first->captured_at) <= tolerance) {
    throw InvalidInput("The scans of the later epoch must be later than those of the earlier one, by more than the " +
                       std::string("contemporary tolerance; choose time windows that do not touch."));
  }
}

/// What was asked of all scans of one epoch.
struct Side {
  std::vector<Detection> detections;  ///< one a scan, without the single answers
  double testable = 0.0;
};

Side ask_about(const EpochScans& epoch, const EpochScans& other, const char* name, const CompareParameters& parameters,
               std::vector<std::string>& warnings) {
  const std::vector<Panorama> coverage = panoramas_of(other);
  Side side;
  double tested = 0.0, usable = 0.0;
  for (std::size_t k = 0; k < epoch.scans.size(); ++k) {
    const ScanView& scan = epoch.scans[k];
    Detection detection = detect_points(scan, overlapping(scan, other, coverage), parameters);
    detection.answers = {};
    tested += detection.testable * static_cast<double>(scan.index.size());
    usable += static_cast<double>(scan.index.size());
    for (const std::string& warning : detection.warnings) {
      warnings.push_back("scan " + std::to_string(k) + " of the " + name + " epoch: " + warning);
    }
    side.detections.push_back(std::move(detection));
  }
  side.testable = usable > 0.0 ? tested / usable : 0.0;
  return side;
}

/// Makes changes of the points of all scans together. To `form_changes` one scan is the compared one and all others are
/// priors, whose changed points it takes as given; what is a prior plays no part in it but for the shares of the votes.
class Pool {
 public:
  Pool(const EpochPair& epochs, Side& before, Side& after) : epochs_(epochs), before_(before), after_(after) {
    for (std::size_t k = 1; k < epochs.after.scans.size(); ++k) add(epochs.after.scans[k], after.detections[k]);
    for (std::size_t k = 0; k < epochs.before.scans.size(); ++k) add(epochs.before.scans[k], before.detections[k]);
    Detection& first = after.detections.front();
    pooled_.classes = first.classes;
    pooled_.free = first.free;
    pooled_.supported = first.supported;
    pooled_.angle_rad.assign(others_.size(), 0.0);
  }

  EpochComparison run(CompareParameters parameters) {
    parameters.clustering = true;
    const Comparison formed = form_changes(epochs_.after.scans.front(), others_, parameters, std::move(pooled_));
    EpochComparison result;
    result.changes = formed.changes;
    result.after.push_back({formed.classes, formed.change_of});
    const std::size_t later = epochs_.after.scans.size() - 1;
    for (std::size_t p = 0; p < others_.size(); ++p) {
      Side& side = p < later ? after_ : before_;
      Detection& detection = side.detections[p < later ? p + 1 : p - later];
      (p < later ? result.after : result.before).push_back(without_changes(std::move(detection.classes)));
    }
    for (const PriorPoint& point : formed.prior_points) {
      EpochPoints& points = point.prior < later ? result.after[point.prior + 1] : result.before[point.prior - later];
      points.classes[point.index] = point.point_class;
      points.change_of[point.index] = point.change;
    }
    count_votes(epochs_.after.scans.size(), before_, result.before, result.changes);
    count_votes(epochs_.before.scans.size(), after_, result.after, result.changes);
    result.testable_before = before_.testable;
    result.testable_after = after_.testable;
    return result;
  }

 private:
  void add(const ScanView& scan, const Detection& detection) {
    const auto prior = static_cast<std::uint32_t>(others_.size());
    others_.push_back(scan);
    for (std::uint32_t i = 0; i < detection.classes.size(); ++i) {
      if (!is_change(detection.classes[i])) continue;
      pooled_.prior_points.push_back({.prior = prior, .index = i, .point_class = detection.classes[i]});
      pooled_.prior_votes.emplace_back();  // `count_votes` counts
    }
  }

  /// Points in no kept cluster count as unchanged, as in one comparison.
  static EpochPoints without_changes(std::vector<PointClass> classes) {
    for (PointClass& point_class : classes) {
      if (is_change(point_class)) point_class = PointClass::unchanged;
    }
    std::vector<std::int32_t> none(classes.size(), -1);
    return {std::move(classes), std::move(none)};
  }

  /// Only the `asked` scans of the other epoch have a vote on the points of one.
  static void count_votes(std::size_t asked, const Side& side, std::span<const EpochPoints> points,
                          std::vector<Change>& changes) {
    std::vector<std::array<double, 3>> sums(changes.size());  // points, free, supported
    for (std::size_t k = 0; k < points.size(); ++k) {
      for (std::size_t i = 0; i < points[k].change_of.size(); ++i) {
        const std::int32_t change = points[k].change_of[i];
        if (change < 0) continue;
        std::array<double, 3>& sum = sums[static_cast<std::size_t>(change)];
        sum[0] += 1.0;
        sum[1] += side.detections[k].free[i];
        sum[2] += side.detections[k].supported[i];
      }
    }
    for (std::size_t c = 0; c < changes.size(); ++c) {
      const auto& [count, free, supported] = sums[c];
      if (count == 0.0) continue;
      const double votes = count * static_cast<double>(asked);
      changes[c].confidence = {.value = free > 0.0 ? free / (free + supported) : 0.0,
                               .free = free / votes,
                               .supported = supported / votes,
                               .unknown = std::max(0.0, 1.0 - (free + supported) / votes)};
    }
  }

  const EpochPair& epochs_;
  Side& before_;
  Side& after_;
  std::vector<ScanView> others_;
  Detection pooled_;
};

void collect_cells(const EpochScans& epoch, std::span<const EpochPoints> points, const GridLayout& layout,
                   std::vector<std::vector<std::size_t>>& cells) {
  for (std::size_t k = 0; k < epoch.scans.size(); ++k) {
    const ScanView& scan = epoch.scans[k];
    for (std::size_t i = 0; i < points[k].change_of.size(); ++i) {
      const std::int32_t change = points[k].change_of[i];
      if (change < 0) continue;
      const Eigen::Vector3d p = scan.world_from_sensor * scan.points[i].cast<double>();
      if (const auto cell = layout.cell_at(p.x(), p.y())) cells[static_cast<std::size_t>(change)].push_back(*cell);
    }
  }
}

}  // namespace

EpochComparison compare_epochs(const EpochPair& epochs, const CompareParameters& parameters) {
  check(epochs, parameters.contemporary_tolerance);
  std::vector<std::string> warnings;
  Side before = ask_about(epochs.before, epochs.after, "earlier", parameters, warnings);
  Side after = ask_about(epochs.after, epochs.before, "later", parameters, warnings);
  EpochComparison comparison = Pool(epochs, before, after).run(parameters);
  comparison.warnings = std::move(warnings);
  return comparison;
}

std::vector<FootprintVolume> volumes_of_changes(const EpochPair& epochs, const EpochComparison& comparison,
                                                const ElevationModel& before, const ElevationModel& after) {
  std::vector<std::vector<std::size_t>> cells(comparison.changes.size());
  collect_cells(epochs.before, comparison.before, before.layout, cells);
  collect_cells(epochs.after, comparison.after, before.layout, cells);
  std::vector<FootprintVolume> volumes;
  for (std::vector<std::size_t>& footprint : cells) {
    std::ranges::sort(footprint);
    footprint.erase(std::ranges::unique(footprint).begin(), footprint.end());
    volumes.push_back(volume_over(before, after, footprint));
  }
  return volumes;
}

}  // namespace raywatch
