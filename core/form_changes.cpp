#include <algorithm>
#include <array>
#include <tuple>

#include "core/cluster.hpp"
#include "core/compare.hpp"
#include "core/fold.hpp"
#include "core/join_parts.hpp"
#include "core/reach.hpp"

namespace raywatch {
namespace {

constexpr std::array<ChangeKind, 3> kKinds{ChangeKind::added, ChangeKind::removed, ChangeKind::discrepancy};

PointClass class_of(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::added:
      return PointClass::added;
    case ChangeKind::removed:
      return PointClass::removed;
    case ChangeKind::discrepancy:
      break;
  }
  return PointClass::discrepancy;
}

/// A changed point in the world, whichever scan it comes from.
struct ChangedPoint {
  Eigen::Vector3d world_m = Eigen::Vector3d::Zero();
  double free = 0.0, supported = 0.0;        ///< shares of the priors
  double agreeing = 0.0, disagreeing = 0.0;  ///< scans that agree that it changed, in relation to the priors
  std::uint32_t place = 0;                   ///< in the scan, or in `Detection::prior_points`
  std::uint32_t view = 0;                    ///< 0: of the scan; else of the prior before that
  float reach_m = 0.0f;
};

ChangedPoint point_of_scan(const Detection& detection, std::uint32_t i, double voters) {
  const double free = detection.free[i] / voters, supported = detection.supported[i] / voters;
  return {.free = free, .supported = supported, .agreeing = free, .disagreeing = supported, .place = i};
}

/// A prior's point changed because the compared scan saw its place free. That its own prior, and others, show the thing
/// agrees with that: it was there.
ChangedPoint point_of_prior(const Detection& detection, std::uint32_t k, double voters) {
  const PriorPointVotes& votes = detection.prior_votes[k];
  const double free = (votes.free - 1) / voters, supported = (votes.supported + 1) / voters;
  return {.free = free,
          .supported = supported,
          .agreeing = supported + 1.0 / voters,
          .disagreeing = free,
          .place = k,
          .view = detection.prior_points[k].prior + 1};
}

std::vector<ChangedPoint> changed_points(ChangeKind kind, const ScanView& scan, std::span<const ScanView> priors,
                                         const CompareParameters& parameters, const Detection& detection) {
  const PointClass wanted = class_of(kind);
  const auto voters = static_cast<double>(std::max<std::size_t>(priors.size(), 1));
  std::vector<ChangedPoint> points;
  const auto add = [&](ChangedPoint point, const ScanView& view, std::uint32_t i) {
    point.world_m = view.world_from_sensor * view.points[i].cast<double>();
    point.reach_m = reach_m(view, view.points[i], parameters);
    points.push_back(point);
  };
  for (std::uint32_t i = 0; i < detection.classes.size(); ++i) {
    if (detection.classes[i] == wanted) add(point_of_scan(detection, i, voters), scan, i);
  }
  for (std::uint32_t k = 0; k < detection.prior_points.size(); ++k) {
    const PriorPoint& point = detection.prior_points[k];
    if (point.point_class == wanted) add(point_of_prior(detection, k, voters), priors[point.prior], point.index);
  }
  return points;
}

/// How far apart the parts of one change may be, in multiples of the reach of its points. In a consensus what is still
/// called changed surely is, so that parts which shadows and lost returns have separated can be joined.
double reach_factor(const CompareParameters& parameters) {
  constexpr double kJoining = 2.0;
  return parameters.grouping == Grouping::union_ ? 1.0 : kJoining;
}

/// The clusters of more than `cluster_min_points` points.
std::vector<Members> kept_clusters(const std::vector<ChangedPoint>& points, const CompareParameters& parameters) {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<float> reaches_m;
  const auto factor = static_cast<float>(reach_factor(parameters));
  for (const ChangedPoint& point : points) {
    positions_m.push_back(point.world_m.cast<float>());
    reaches_m.push_back(factor * point.reach_m);
  }
  const std::vector<std::uint32_t> cluster_of = cluster_points(positions_m, reaches_m);
  std::vector<Members> clusters;
  for (std::uint32_t i = 0; i < cluster_of.size(); ++i) {
    if (cluster_of[i] >= clusters.size()) clusters.resize(cluster_of[i] + 1);
    clusters[cluster_of[i]].push_back(i);
  }
  std::erase_if(clusters, [&](const Members& members) { return members.size() <= parameters.cluster_min_points; });
  return clusters;
}

Change describe(ChangeKind kind, const std::vector<ChangedPoint>& points, const Members& members) {
  Change change{.kind = kind, .points = members.size()};
  double agreeing = 0.0, disagreeing = 0.0;
  Eigen::Matrix3Xd positions_m(3, static_cast<Eigen::Index>(members.size()));
  for (std::size_t k = 0; k < members.size(); ++k) {
    const ChangedPoint& point = points[members[k]];
    positions_m.col(static_cast<Eigen::Index>(k)) = point.world_m;
    change.bounds_m.extend(point.world_m);
    change.confidence.free += point.free;
    change.confidence.supported += point.supported;
    agreeing += point.agreeing;
    disagreeing += point.disagreeing;
  }
  const auto n = static_cast<double>(members.size());
  change.centroid_m = positions_m.rowwise().mean();
  change.box = bounding_box(positions_m);
  change.volume_m3 = change.box.size_m.prod();
  change.confidence.free = std::min(change.confidence.free / n, 1.0);
  change.confidence.supported = std::min(change.confidence.supported / n, 1.0);
  change.confidence.unknown = std::max(0.0, 1.0 - change.confidence.free - change.confidence.supported);
  change.confidence.value = agreeing > 0.0 ? agreeing / (agreeing + disagreeing) : 0.0;
  return change;
}

/// The changes of one kind with their members, the largest first.
struct FoundChange {
  Change change;
  Members members;
};

/// What is seen of one thing through gaps in other things, or before and behind its own near side, is one change.
std::vector<Members> whole_things(std::vector<Members> clusters, const std::vector<ChangedPoint>& points,
                                  const std::vector<const ScanView*>& views, const CompareParameters& parameters) {
  if (parameters.grouping == Grouping::union_) return clusters;
  std::vector<Eigen::Vector3d> world_m;
  std::vector<std::uint32_t> view_of;
  for (const ChangedPoint& point : points) {
    world_m.push_back(point.world_m);
    view_of.push_back(point.view);
  }
  return join_parts(std::move(clusters), {world_m, view_of, views}, parameters);
}

std::vector<FoundChange> find_changes(ChangeKind kind, const std::vector<ChangedPoint>& points,
                                      const std::vector<const ScanView*>& views, const CompareParameters& parameters) {
  std::vector<FoundChange> found;
  for (Members& members : whole_things(kept_clusters(points, parameters), points, views, parameters)) {
    Change change = describe(kind, points, members);
    found.push_back({std::move(change), std::move(members)});
  }
  std::sort(found.begin(), found.end(), [](const FoundChange& a, const FoundChange& b) {
    const auto& p = a.change.centroid_m;
    const auto& q = b.change.centroid_m;
    return std::make_tuple(b.change.points, p.x(), p.y(), p.z(), a.members.front()) <
           std::make_tuple(a.change.points, q.x(), q.y(), q.z(), b.members.front());
  });
  return found;
}

/// A changed point in no kept cluster counts as unchanged.
void drop_noise(Comparison& comparison) {
  for (std::size_t i = 0; i < comparison.classes.size(); ++i) {
    PointClass& point_class = comparison.classes[i];
    if (is_change(point_class) && comparison.change_of[i] < 0) point_class = PointClass::unchanged;
  }
  std::erase_if(comparison.prior_points, [](const PriorPoint& point) { return point.change < 0; });
}

void count(Comparison& comparison, const std::vector<std::vector<Answer>>& answers) {
  for (std::size_t i = 0; i < comparison.classes.size(); ++i) {
    ++comparison.counts[static_cast<std::size_t>(comparison.classes[i])];
    if (!is_change(comparison.classes[i])) continue;
    for (std::size_t p = 0; p < answers.size(); ++p) comparison.priors[p].added += answers[p][i] == Answer::free;
  }
  for (const PriorPoint& point : comparison.prior_points) {
    ++comparison.counts[static_cast<std::size_t>(point.point_class)];
    ++comparison.priors[point.prior].removed;
  }
}

}  // namespace

Comparison form_changes(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters,
                        Detection detection) {
  Comparison comparison;
  comparison.change_of.assign(detection.classes.size(), -1);
  if (parameters.clustering) {
    std::vector<const ScanView*> views{&scan};
    for (const ScanView& prior : priors) views.push_back(&prior);
    for (const ChangeKind kind : kKinds) {
      const std::vector<ChangedPoint> points = changed_points(kind, scan, priors, parameters, detection);
      for (FoundChange& found : find_changes(kind, points, views, parameters)) {
        const auto number = static_cast<std::int32_t>(comparison.changes.size());
        for (const std::uint32_t member : found.members) {
          const ChangedPoint& point = points[member];
          (point.view == 0 ? comparison.change_of[point.place] : detection.prior_points[point.place].change) = number;
        }
        comparison.changes.push_back(std::move(found.change));
      }
    }
  }
  comparison.classes = std::move(detection.classes);
  comparison.free = std::move(detection.free);
  comparison.supported = std::move(detection.supported);
  comparison.prior_points = std::move(detection.prior_points);
  comparison.testable = detection.testable;
  comparison.warnings = std::move(detection.warnings);
  for (const double angle_rad : detection.angle_rad) comparison.priors.push_back({.angle_rad = angle_rad});
  if (parameters.clustering) drop_noise(comparison);
  count(comparison, detection.answers);
  return comparison;
}

}  // namespace raywatch
