#pragma once

#include <optional>
#include <string>
#include <vector>

#include "storage/baselines.hpp"
#include "storage/rules.hpp"
#include "storage/sensors.hpp"
#include "storage/zones.hpp"
#include "tests/server/watched_site.hpp"

namespace raywatch {

/// What stands before the wall, 10 m away, that a fixed sensor in the origin watches in steps of one degree.
struct WatchedScene {
  std::optional<double> box_y_m;     ///< a cube of 1 m whose near face is at x = 4.5 m
  std::optional<double> person_y_m;  ///< a pillar 0.6 m wide and 1.8 m high, at x = 7 m
  bool screen = false;               ///< a board 1.2 m wide and high, at x = 2.5 m, straight ahead
};

/// A watched site, one scan a minute.
class WatchedPlace {
 public:
  explicit WatchedPlace(const WatchConfig& watch = {});

  /// Takes a scan and has it compared with `previous` and with the baseline.
  ScanId take(const WatchedScene& scene = {}, const std::string& sensor = "mast");
  /// The same, so long after (or before) the next minute; the clock does not move.
  ScanId take_at(Duration offset, const WatchedScene& scene = {}, const std::string& sensor = "mast");
  void learn() {
    for (int i = 0; i < 3; ++i) take();
  }

  std::vector<TrackRecord> tracks() const { return watched_.tracks(); }  ///< oldest first
  std::vector<AlertRecord> alerts() const { return watched_.alerts(); }  ///< oldest first
  std::vector<BaselineEntry> baseline() const;
  std::vector<std::string> events() const;  ///< their types
  WatchRole role(ScanId scan) const;
  std::vector<ChangeRecord> watching_changes() const;  ///< newest first

  Store& store() { return watched_.store(); }
  SiteId site() const { return watched_.id(); }
  Time now() const { return watched_.now(); }

 private:
  const Store& store() const { return watched_.store(); }

  WatchedSite watched_;
  int number_ = 0;
};

}  // namespace raywatch
