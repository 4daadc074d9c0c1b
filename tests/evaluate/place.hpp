#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/profile.hpp"
#include "tests/simulator/family.hpp"

namespace raywatch::evaluation {

using simulator::SimulatedScan;
using simulator::StateId;

/// What a label stands for: one object while it stays at one place.
struct LabelledState {
  StateId id = 0;
  std::string name;
  std::string kind;
};

/// Scans of one place with their truth, in order of time.
struct Place {
  std::string name;
  std::vector<SimulatedScan> scans;
  std::vector<LabelledState> states;
};

/// The profile whose defaults suit a family of places.
Profile profile_of(simulator::Family family);

/// Simulates a place of a family. Runs in the caller's oneTBB arena.
Place simulate_place(simulator::Family family, const simulator::FamilyOptions& options);

/// Reads a folder as `raywatch-simulate` writes it: `manifest.json`, and for each of its scans the file with its
/// side-car and labels (EVALUATION.md says how to write them). The true poses are not needed.
/// Map coordinates are moved near the origin.
/// @throws InvalidInput naming the file, when the folder has no manifest, a scan has no labels or another number of
/// them
///   than points, nothing says from where or when it was taken, or its file is broken.
Place read_place(const std::filesystem::path& folder);

}  // namespace raywatch::evaluation
