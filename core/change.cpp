#include "core/change.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/names.hpp"

namespace raywatch {
namespace {

constexpr Names<ChangeKind, 3> kKindNames{
    {{ChangeKind::added, "added"}, {ChangeKind::removed, "removed"}, {ChangeKind::discrepancy, "discrepancy"}}};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Andrew's monotone chain: the convex hull counter-clockwise without collinear points. O(n log n).
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  const auto less = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  const auto extend = [&](const Eigen::Vector2d& point, std::size_t floor) {
    while (hull.size() > floor && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const auto& point : points) extend(point, 1);
  const std::size_t lower = hull.size();
  for (auto it = points.rbegin() + 1; it != points.rend(); ++it) extend(*it, lower);
  hull.pop_back();
  return hull;
}

struct Rectangle {
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();  ///< of the first side
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
};

Rectangle rectangle_along(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& axis) {
  const Eigen::Vector2d normal(-axis.y(), axis.x());
  Eigen::AlignedBox2d box;
  for (const auto& point : hull) box.extend(Eigen::Vector2d(axis.dot(point), normal.dot(point)));
  const Eigen::Vector2d center = box.center();
  return {axis, axis * center.x() + normal * center.y(), box.sizes()};
}

/// One side of the smallest rectangle lies on an edge of the hull (Freeman and Shapira 1975). The hull of a cluster is
/// small, so every edge is tried against every corner; above `kMostEdges` edges, evenly chosen ones.
Rectangle smallest_rectangle(const std::vector<Eigen::Vector2d>& hull) {
  constexpr std::size_t kMostEdges = 512;
  Rectangle best = rectangle_along(hull, Eigen::Vector2d::UnitX());
  if (hull.size() < 2) return best;
  double least_area = std::numeric_limits<double>::infinity();
  const std::size_t tried = std::min(hull.size(), kMostEdges);
  for (std::size_t k = 0; k < tried; ++k) {
    const std::size_t i = k * hull.size() / tried;
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (edge.norm() <= 0.0) continue;
    const Rectangle candidate = rectangle_along(hull, edge.normalized());
    const double area = candidate.size.prod();
    if (area < least_area) {
      least_area = area;
      best = candidate;
    }
  }
  return best;
}

}  // namespace

std::string_view to_string(ChangeKind kind) { return name_of(kKindNames, kind); }
ChangeKind parse_change_kind(std::string_view name) { return value_of(kKindNames, name, "kind"); }

OrientedBox bounding_box(const Eigen::Matrix3Xd& points_m) {
  std::vector<Eigen::Vector2d> plan;
  plan.reserve(static_cast<std::size_t>(points_m.cols()));
  for (Eigen::Index i = 0; i < points_m.cols(); ++i) plan.emplace_back(points_m(0, i), points_m(1, i));
  Rectangle rectangle = smallest_rectangle(convex_hull(std::move(plan)));
  if (rectangle.size.y() > rectangle.size.x()) {
    rectangle.axis = Eigen::Vector2d(-rectangle.axis.y(), rectangle.axis.x());
    std::swap(rectangle.size.x(), rectangle.size.y());
  }
  if (rectangle.axis.x() < 0.0) rectangle.axis = -rectangle.axis;
  const double bottom_m = points_m.row(2).minCoeff();
  const double top_m = points_m.row(2).maxCoeff();
  OrientedBox box;
  box.center_m = {rectangle.center.x(), rectangle.center.y(), 0.5 * (bottom_m + top_m)};
  box.size_m = {rectangle.size.x(), rectangle.size.y(), top_m - bottom_m};
  box.world_from_box = Eigen::AngleAxisd(std::atan2(rectangle.axis.y(), rectangle.axis.x()), Eigen::Vector3d::UnitZ());
  return box;
}

}  // namespace raywatch
