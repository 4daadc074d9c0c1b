#pragma once

#include <string>
#include <vector>

#include "tests/simulator/family.hpp"
#include "tests/simulator/random.hpp"
#include "tests/simulator/things.hpp"

/// What the stories of the families have in common.
namespace raywatch::simulator {

/// A pose that looks along `yaw_rad`, tilted down by `pitch_rad`.
struct Viewpoint {
  Eigen::Vector3d position_m;
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;

  Pose pose() const {
    return {
        Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()),
        position_m};
  }
};

/// Which of the two poses is the nominal one when they differ by the registration error.
enum class Mount {
  carried,  ///< the scan is taken from the nominal pose, and reported with an error
  fixed,    ///< the nominal pose is reported, and the mount has moved
};

/// A place from which a story is seen, again and again.
struct Lookout {
  std::string sensor;
  std::size_t scanner = 0;
  Pose nominal_world_from_sensor;
  Mount mount = Mount::carried;
};

/// Appends a scan from a lookout to the timeline.
struct NextScan {
  const Lookout& lookout;
  Time captured_at;
  std::vector<StateId> present;
  std::vector<Shape> passing = {};
  bool windy = false;
};
void append_scan(Timeline& timeline, const FamilyOptions& options, NextScan scan);

Time start_of(const FamilyOptions& options);

/// A number of steps per turn or height, for the wanted density; at least 4.
std::uint32_t steps_at_density(std::uint32_t usual, double density);

/// 64 rings of 1800 shots at density 1, with the noise of such a sensor.
Scanner ring_scanner(const FamilyOptions& options);

/// The same at density 1, so that what a story places does not depend on the density.
Scanner usual_scanner(const FamilyOptions& options);

/// How many returns without noise the lookout gets from an object that stands in the scene. Trees are left out: they
/// stand behind everything that a story tells of.
std::size_t returns_from(const Timeline& timeline, const Lookout& lookout, const std::vector<StateId>& present,
                         StateId object);

/// Adds shapes to the background.
void append(Timeline& timeline, const Shapes& shapes);

/// Plants trees in a row, roughly one in each of `count` equal parts of the line.
struct TreeRow {
  Eigen::Vector2d from_m;
  Eigen::Vector2d to_m;
  int count;
};
void plant(Timeline& timeline, RandomSequence& random, const TreeRow& row);

/// The smallest number of returns of an object that a story relies on.
inline constexpr std::size_t kSeen = 30;

Timeline sim_timeline(const FamilyOptions& options);
Timeline lab_timeline(const FamilyOptions& options);
Timeline carpark_timeline(const FamilyOptions& options);
struct YardStory {
  std::size_t sensors = 2;
  std::uint32_t quiet_rounds = 2;  ///< before the first change
  std::uint32_t rounds = 12;       ///< in each, every sensor takes a scan
  /// 0: much happens, for demonstrations and evaluation by scans. Else something lasting happens every so many rounds,
  /// and in a third of all others somebody passes.
  std::uint32_t rounds_apart = 0;
};
Timeline yard_timeline(const FamilyOptions& options, const YardStory& story);
Timeline mine_timeline(const FamilyOptions& options);
Timeline pit_timeline(const FamilyOptions& options);

}  // namespace raywatch::simulator
