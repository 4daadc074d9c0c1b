#pragma once

#include <Eigen/Geometry>
#include <map>
#include <span>
#include <vector>

#include "core/place_history.hpp"
#include "core/sensor.hpp"
#include "storage/payloads.hpp"
#include "storage/scans.hpp"
#include "storage/sites.hpp"

namespace raywatch {

/// Places that stored scans are asked about together, in the local frame, and a ball that holds them.
struct PlaceQuestion {
  std::vector<Eigen::Vector3d> places_m;
  Eigen::Vector3d center_m;
  double radius_m = 0.0;
};
PlaceQuestion question_at(const Eigen::Vector3d& place_m);
/// Some places, evenly spread over a box.
PlaceQuestion question_in(const Eigen::AlignedBox3d& box_m);

/// What each scan shows of the places, in the order of the scans. Of every scan only those chunks are read whose
/// directions meet the ball. Runs in the caller's oneTBB arena.
/// @param known what is known of each scan's sensor.
/// @throws CorruptData, NotFound as `Payloads`.
std::vector<PlaceSight> sights_of(const Payloads& payloads, const Site& site, std::span<const ScanRecord> scans,
                                  const std::map<SensorId, SensorModel>& known, const PlaceQuestion& question);

}  // namespace raywatch
