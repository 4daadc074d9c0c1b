#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "tests/simulator/family.hpp"

namespace raywatch::simulator {

/// Writes scans and their truth into a folder:
/// - NAME.pcd, the scan, with its VIEWPOINT as reported; NAME.pcd.json, its side-car
/// - NAME.pcd.labels, the truth: "RWLB", u32 version = 1, u64 number of points n, n u16 state ids; little endian
/// - manifest.json, what the folder holds: scans with true and reported poses, and every state of every object
class SceneFolder {
 public:
  /// Creates the folder if it does not exist.
  explicit SceneFolder(std::filesystem::path folder);

  /// Returns the name of the scan's file.
  std::string add(const std::string& name, const SimulatedScan& scan);

  /// To be called when all scans have been added.
  void write_manifest(Family family, const FamilyOptions& options, const Timeline& timeline) const;

 private:
  /// What the manifest says about a scan.
  struct Entry {
    std::string file;
    std::string sensor;
    Time captured_at;
    Pose true_world_from_sensor;
    Pose reported_world_from_sensor;
    std::size_t points;
    std::vector<StateId> present;
  };

  std::filesystem::path folder_;
  std::vector<Entry> entries_;
};

void write_labels(std::ostream& out, const std::vector<StateId>& labels);

/// @throws InvalidInput when the stream holds something else.
std::vector<StateId> read_labels(std::istream& in);

}  // namespace raywatch::simulator
