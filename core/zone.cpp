#include "core/zone.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/look.hpp"
#include "core/names.hpp"

namespace raywatch {
namespace {

constexpr Names<ZoneKind, 4> kZoneKinds{{{ZoneKind::alert, "alert"},
                                         {ZoneKind::ignore, "ignore"},
                                         {ZoneKind::control, "control"},
                                         {ZoneKind::volume, "volume"}}};

using Polygon = std::vector<Eigen::Vector2d>;

const Eigen::Vector2d& corner(const Polygon& polygon, std::size_t i) { return polygon[i % polygon.size()]; }

/// Twice the signed area of a triangle; 0 when its corners lie on one line.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

double area_m2(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += turn(polygon[0], polygon[i], corner(polygon, i + 1));
  return 0.5 * std::abs(twice);
}

bool is_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  return turn(a, b, p) == 0.0 && (p - a).dot(p - b) <= 0.0;
}

bool sides_meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Eigen::Vector2d& d) {
  const bool c_and_d_apart = (turn(a, b, c) > 0.0) != (turn(a, b, d) > 0.0);
  const bool a_and_b_apart = (turn(c, d, a) > 0.0) != (turn(c, d, b) > 0.0);
  return (c_and_d_apart && a_and_b_apart) || is_between(a, b, c) || is_between(a, b, d) || is_between(c, d, a) ||
         is_between(c, d, b);
}

/// Sides that follow each other share a corner; all others must stay apart.
bool crosses_itself(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (sides_meet(polygon[i], polygon[i + 1], polygon[j], corner(polygon, j + 1))) return true;
    }
  }
  return false;
}

/// The crossings of a ray to the right are counted; a corner counts for the side above it. Where a side crosses is
/// computed from its lower end, so that it is the same for both prisms that share the side.
bool polygon_contains(const Polygon& polygon, double x_m, double y_m) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Eigen::Vector2d a = polygon[i], b = corner(polygon, i + 1);
    if ((a.y() > y_m) == (b.y() > y_m)) continue;
    if (b.y() < a.y()) std::swap(a, b);
    if (x_m < a.x() + (y_m - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

/// A side that is shorter than the spacing still gets one place, in its middle.
std::vector<Eigen::Vector3d> places_of_lattice(const Prism& prism, double spacing_m) {
  Eigen::AlignedBox2d plan;
  for (const Eigen::Vector2d& p : prism.polygon_m) plan.extend(p);
  const Eigen::Vector3d low_m(plan.min().x(), plan.min().y(), prism.z_min_m);
  const Eigen::Array3d size_m(plan.sizes().x(), plan.sizes().y(), prism.z_max_m - prism.z_min_m);
  const Eigen::Array3i steps = (size_m / spacing_m).round().max(1.0).cast<int>();
  const Eigen::Array3d step_m = size_m / steps.cast<double>();
  std::vector<Eigen::Vector3d> places;
  for (int k = 0; k < steps.z(); ++k) {
    for (int j = 0; j < steps.y(); ++j) {
      for (int i = 0; i < steps.x(); ++i) {
        const Eigen::Vector3d place_m = low_m.array() + (Eigen::Array3d(i, j, k) + 0.5) * step_m;
        if (contains(prism, place_m)) places.push_back(place_m);
      }
    }
  }
  return places;
}

}  // namespace

std::string_view to_string(ZoneKind kind) { return name_of(kZoneKinds, kind); }
ZoneKind parse_zone_kind(std::string_view name) { return value_of(kZoneKinds, name, "kind"); }

void check_prism(const Prism& prism) {
  constexpr std::size_t kMostCorners = 1000;
  constexpr double kLeastArea_m2 = 1e-6;
  std::vector<FieldError> errors;
  const Polygon& polygon = prism.polygon_m;
  const bool finite =
      std::all_of(polygon.begin(), polygon.end(), [](const Eigen::Vector2d& p) { return p.allFinite(); });
  if (polygon.size() < 3 || polygon.size() > kMostCorners || !finite) {
    errors.push_back({"polygon_m", "must have 3 to 1000 corners, each [x, y]"});
  } else if (polygon.front() == polygon.back()) {
    errors.push_back({"polygon_m", "must not repeat the first corner; the last side leads back to it by itself"});
  } else if (crosses_itself(polygon)) {
    errors.push_back({"polygon_m", "must not cross or touch itself; give the corners in their order around the zone"});
  } else if (area_m2(polygon) < kLeastArea_m2) {
    errors.push_back({"polygon_m", "must enclose an area"});
  }
  if (!std::isfinite(prism.z_min_m)) errors.push_back({"z_min_m", "must be finite"});
  if (!std::isfinite(prism.z_max_m)) errors.push_back({"z_max_m", "must be finite"});
  if (!(prism.z_min_m < prism.z_max_m)) errors.push_back({"z_max_m", "must be above z_min_m"});
  if (!errors.empty()) throw InvalidInput("The zone has no proper shape.", std::move(errors));
}

bool contains(const Prism& prism, const Eigen::Vector3d& place_m) {
  return place_m.z() >= prism.z_min_m && place_m.z() <= prism.z_max_m &&
         polygon_contains(prism.polygon_m, place_m.x(), place_m.y());
}

double share_inside(const Prism& prism, const OrientedBox& box) {
  constexpr int kSteps = 5;
  int inside = 0;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const Eigen::Vector3d step(i % kSteps, i / kSteps % kSteps, i / (kSteps * kSteps));
    const Eigen::Vector3d offset_m = ((step.array() + 0.5) / kSteps - 0.5) * box.size_m.array();
    inside += contains(prism, box.center_m + box.world_from_box * offset_m) ? 1 : 0;
  }
  return inside / static_cast<double>(kSteps * kSteps * kSteps);
}

std::vector<Eigen::Vector3d> lattice_places(const Prism& prism, std::size_t count) {
  constexpr double kMostTried = 1e5;
  Eigen::AlignedBox2d plan;
  for (const Eigen::Vector2d& p : prism.polygon_m) plan.extend(p);
  const double height_m = prism.z_max_m - prism.z_min_m;
  const double finest_m = std::cbrt(plan.volume() * height_m / kMostTried);
  const double wanted_m = std::cbrt(area_m2(prism.polygon_m) * height_m / static_cast<double>(count));
  std::vector<Eigen::Vector3d> places = places_of_lattice(prism, std::max(wanted_m, finest_m));
  // A narrow prism may lie between the places of a coarse lattice.
  return places.empty() ? places_of_lattice(prism, finest_m) : places;
}

double judged_share(const ScanView& scan, std::span<const Eigen::Vector3d> places_m,
                    const CompareParameters& parameters) {
  if (places_m.empty()) return 0.0;
  const std::vector<Answer> answers = look_at(scan, places_m, parameters);
  const auto judged = std::count_if(answers.begin(), answers.end(), [](Answer answer) {
    return answer == Answer::free || answer == Answer::supported;
  });
  return static_cast<double>(judged) / static_cast<double>(places_m.size());
}

}  // namespace raywatch
