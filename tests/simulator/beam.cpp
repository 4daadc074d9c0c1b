#include "tests/simulator/beam.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raywatch::simulator {
namespace {

constexpr std::size_t kRays = 5;
/// How far from the axis the four outer rays run, as a share of the beam's half angle: they then stand for equal parts
/// of the beam's disc.
constexpr double kOuterRay = 0.79;
/// Surfaces nearer to each other than this along the beam are one surface: nothing stands between them.
constexpr double kOneSurface_m = 0.05;
/// The nearer surface takes the whole return when it stops at least this share of what came back.
constexpr double kNearerTakesAll = 0.8;
/// The steepest chord between two hits of one stretch of terrain, against its tangent plane.
constexpr double kOneSlope = 0.26;

struct RayHit {
  Hit hit;
  Eigen::Vector3d place_m;
  bool on_axis;
};

/// Hits that belong to one surface, from first to last.
struct Surface {
  double range_m;
  std::size_t rays;
  StateId state;
};

std::array<Eigen::Vector3d, kRays> directions(const Eigen::Vector3d& axis, double divergence_rad) {
  const double offset = kOuterRay * std::tan(0.5 * divergence_rad);
  const Eigen::Vector3d right = axis.unitOrthogonal() * offset;
  const Eigen::Vector3d up = axis.cross(right);
  return {axis, (axis + right).normalized(), (axis - right).normalized(), (axis + up).normalized(),
          (axis - up).normalized()};
}

/// Whether two hits on one terrain belong to one slope, and not to two hills behind each other.
bool on_one_slope(const HeightField& field, const RayHit& a, const RayHit& b) {
  const Eigen::Vector3d chord = b.place_m - a.place_m;
  return std::abs(field.normal(a.place_m.head<2>()).dot(chord)) <= kOneSlope * chord.norm();
}

bool on_one_surface(const Scene& scene, const RayHit& a, const RayHit& b) {
  if (std::abs(a.hit.range_m - b.hit.range_m) <= kOneSurface_m) return true;
  if (a.hit.solid != b.hit.solid) return false;
  const auto* terrain = std::get_if<Terrain>(&scene.solids[a.hit.solid].shape);
  return terrain == nullptr || on_one_slope(*terrain->field, a, b);
}

Surface surface_of(std::span<const RayHit> hits) {
  Surface surface{0.0, hits.size(), hits.front().hit.state};
  std::size_t votes = 0;
  for (const RayHit& ray : hits) {
    surface.range_m += ray.hit.range_m / static_cast<double>(hits.size());
    const auto same = static_cast<std::size_t>(
        std::ranges::count_if(hits, [&](const RayHit& other) { return other.hit.state == ray.hit.state; }));
    if (same > votes) {
      votes = same;
      surface.state = ray.hit.state;
    }
  }
  // Where the beam's centre meets the surface, the pulse is centred there too.
  const auto axis = std::ranges::find_if(hits, &RayHit::on_axis);
  if (axis != hits.end()) surface.range_m = axis->hit.range_m;
  return surface;
}

Return mixed_return(const Surface& near, const Surface& far, double blend_length_m) {
  const double near_share = static_cast<double>(near.rays) / static_cast<double>(near.rays + far.rays);
  if (near_share >= kNearerTakesAll) return {near.range_m, near.state};
  if (far.range_m - near.range_m > blend_length_m) {
    return near_share >= 0.5 ? Return{near.range_m, near.state} : Return{far.range_m, far.state};
  }
  const double range_m = near_share * near.range_m + (1.0 - near_share) * far.range_m;
  if (range_m - near.range_m <= kOneSurface_m) return {range_m, near.state};
  if (far.range_m - range_m <= kOneSurface_m) return {range_m, far.state};
  return {range_m, kNoSurface};
}

/// What the rays of one beam hit, by range. At most `kRays`, so a plain array is enough.
struct BeamHits {
  std::array<RayHit, kRays> hits;
  std::size_t count = 0;

  void insert(const RayHit& hit) {
    std::size_t place = count++;
    for (; place > 0 && hit.hit.range_m < hits[place - 1].hit.range_m; --place) hits[place] = hits[place - 1];
    hits[place] = hit;
  }
};

BeamHits trace_rays(const RayCaster& world, const Ray& axis, double divergence_rad) {
  BeamHits found;
  for (const Eigen::Vector3d& direction : directions(axis.direction, divergence_rad)) {
    const Ray ray{axis.origin_m, direction};
    if (const auto hit = world.cast(ray)) found.insert({*hit, ray.at(hit->range_m), direction == axis.direction});
  }
  return found;
}

/// The two surfaces that stop most of the beam; the nearer one of equals.
struct MainSurfaces {
  Surface strongest;
  std::optional<Surface> second;

  void offer(const Surface& surface) {
    if (strongest.rays == 0) {
      strongest = surface;
    } else if (surface.rays > strongest.rays) {
      second = strongest;
      strongest = surface;
    } else if (!second || surface.rays > second->rays) {
      second = surface;
    }
  }
};

MainSurfaces main_surfaces(const Scene& scene, const BeamHits& found) {
  MainSurfaces surfaces{};
  for (std::size_t first = 0; first < found.count;) {
    std::size_t end = first + 1;
    while (end < found.count && on_one_surface(scene, found.hits[end - 1], found.hits[end])) ++end;
    surfaces.offer(surface_of(std::span(found.hits).subspan(first, end - first)));
    first = end;
  }
  return surfaces;
}

}  // namespace

std::optional<Return> trace_beam(const RayCaster& world, const Ray& axis, const ScannerErrors& errors) {
  if (errors.beam_divergence_rad == 0.0) {
    const auto hit = world.cast(axis);
    return hit ? std::optional(Return{hit->range_m, hit->state}) : std::nullopt;
  }
  const BeamHits found = trace_rays(world, axis, errors.beam_divergence_rad);
  if (found.count == 0) return std::nullopt;
  const auto [strongest, second] = main_surfaces(world.scene(), found);
  if (!second) return Return{strongest.range_m, strongest.state};
  const bool strongest_first = strongest.range_m < second->range_m;
  return mixed_return(strongest_first ? strongest : *second, strongest_first ? *second : strongest,
                      errors.blend_length_m);
}

}  // namespace raywatch::simulator
