#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tests/simulator/timeline.hpp"

namespace raywatch::simulator {

/// Kinds of places. Each makes unlimited different scenes, by its seed.
/// - sim: a room of 100 m, boxes come and go, a grid of 1 degree, no noise; four poses
/// - lab: a box of 14 x 17 x 40 cm moves among four places of a cluttered room; 64 rings, 2 cm noise; three poses
/// - carpark: cars are moved, leave and arrive; 64 rings; three poses
/// - yard: two fixed sensors; a bag is left, a crate removed, a person passes; fence, trees in the wind; 64 rings
/// - mine: a bench is blasted, the rock dug away; a tripod scanner on two stations, one night apart
/// - pit: the same pit seen from the wall opposite the bench by two light scanners, night after night; with the true
///   heights of the ground, so that volumes can be checked
/// - stream: the yard with one sensor, in which at first nothing happens, for demonstrations
enum class Family { sim, lab, carpark, yard, mine, pit, stream };

inline constexpr Family kFamilies[] = {Family::sim,  Family::lab, Family::carpark, Family::yard,
                                       Family::mine, Family::pit, Family::stream};

std::string_view to_string(Family family);
/// @throws InvalidInput naming the known ones.
Family parse_family(std::string_view name);

struct FamilyOptions {
  std::uint64_t seed = 1;
  /// More clutter, and a registration error of 1 cm and 0.05 degrees (standard deviations of each axis).
  bool hard = false;
  /// Shots in relation to the family's usual scanner, which has its angular steps changed by the square root.
  double density = 1.0;
  std::optional<std::uint32_t> scans = {};  ///< not given: as many as the family's story needs
  std::optional<Time> start = {};           ///< of the first scan; not given: 2026-03-01T08:00:00Z
  std::optional<Duration> interval = {};    ///< between scans of one epoch (yard, stream: between scans of one sensor)
};

/// The story of a place: what is there when, and from where it is scanned. Depends on the options only.
Timeline make_timeline(Family family, const FamilyOptions& options);

/// All scans of the story. They can take gigabytes for `mine`; `take_scan` makes one at a time.
std::vector<SimulatedScan> simulate(Family family, const FamilyOptions& options);

}  // namespace raywatch::simulator
