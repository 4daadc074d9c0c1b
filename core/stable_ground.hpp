#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/align.hpp"
#include "core/survey_definition.hpp"
#include "core/zone.hpp"

namespace raywatch {

/// The places, in a scan's points, of those that lie in one of the prisms, such as control zones; usable ones only.
std::vector<std::uint32_t> points_in(const ScanView& scan, std::span<const Prism> prisms);
/// The places of the points that a first comparison found unchanged.
std::vector<std::uint32_t> unchanged_points(std::span<const PointClass> classes);

/// How a scan stands to the reference epoch after it was fitted to it on stable ground.
struct StableRegistration {
  Alignment alignment;                      ///< its uncertainty is that of the fit: see `Information::uncertainty`
  std::size_t points = 0;                   ///< on stable ground
  std::optional<std::string> refused = {};  ///< why the scan must not be used: what is wrong and what would help
};

struct StableParameters {
  AlignParameters align = {};
  RegistrationTolerance tolerance = {};
  std::size_t least_points = 2000;  ///< on stable ground
};

/// Refines the pose of a scan against the scans of a reference epoch, on stable ground alone: what changed, or may
/// change, has no part in it. Refused when there is too little stable ground, when it does not hold the scan in all six
/// directions of motion (as a plane does not: nothing keeps the scan from sliding on it), when the surfaces do not fit,
/// and when residual or uncertainty are out of tolerance.
///
/// Deterministic; in the caller's oneTBB arena.
/// @param stable places in the scan's points.
StableRegistration register_on(const ScanView& scan, std::span<const std::uint32_t> stable,
                               std::span<const ScanView> references, const StableParameters& parameters);

}  // namespace raywatch
