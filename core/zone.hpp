#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/change.hpp"
#include "core/compare.hpp"

namespace raywatch {

/// What a zone is for.
enum class ZoneKind : std::uint8_t {
  alert,    ///< rules look here
  ignore,   ///< what changes here raises no alert, whatever other zones it lies in
  control,  ///< nothing may change here: if it does, the scan is suspect, not the world
  volume,   ///< where volumes are measured
};
std::string_view to_string(ZoneKind kind);
/// @throws InvalidInput naming the known ones.
ZoneKind parse_zone_kind(std::string_view name);

/// A polygon in the horizontal plane, and a range of heights. Closed by itself: the last corner leads to the first.
struct Prism {
  std::vector<Eigen::Vector2d> polygon_m;
  double z_min_m = 0.0;
  double z_max_m = 0.0;
};

/// @throws InvalidInput naming `polygon_m`, `z_min_m` or `z_max_m` unless there are 3 to 1000 finite corners whose
/// sides do not cross, around more than nothing, and z_min_m < z_max_m.
void check_prism(const Prism& prism);

/// Whether a place lies in the prism. Its upper and lower faces belong to it; of its sides, each belongs to one of two
/// prisms that share it.
bool contains(const Prism& prism, const Eigen::Vector3d& place_m);

/// The share of a box that lies in the prism, 0..1, counted on a lattice of 5 x 5 x 5 places in the box.
double share_inside(const Prism& prism, const OrientedBox& box);

/// A change lies in a zone when at least this share of its box does.
inline constexpr double kShareInZone = 0.25;

/// Places in the prism, on a lattice whose spacing is such that there are about `count` (>= 1); of a prism that is all
/// but flat there may be others, or none. The same prism gives the same places.
std::vector<Eigen::Vector3d> lattice_places(const Prism& prism, std::size_t count);

/// The share of places (world) about which a scan can tell whether they were free or occupied; 0 without places.
double judged_share(const ScanView& scan, std::span<const Eigen::Vector3d> places_m,
                    const CompareParameters& parameters);

}  // namespace raywatch
