#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "core/sensor.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/payloads.hpp"
#include "storage/registration.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"

namespace raywatch {

enum class ScanState : std::uint8_t { queued, comparing, compared, failed };
std::string_view to_string(ScanState state);

/// A place from which scans are taken.
struct Vantage {
  VantageId id;
  SiteId site;
  Eigen::Vector3d position_m;  ///< local
  std::uint64_t scans = 0;
  std::optional<Time> first_captured_at, last_captured_at;
};
/// Scans nearer than this to a vantage belong to it.
inline constexpr double kVantageRadius_m = 0.25;

/// A stored scan without its points.
struct ScanRecord {
  ScanId id;
  SiteId site;
  SensorId sensor;
  VantageId vantage;
  Time captured_at;
  Time received_at;
  std::uint64_t points = 0;
  std::string sha256;  ///< of the received bytes (with "#N" behind it for the N-th scan of a file with several)
  Pose pose;           ///< world_from_sensor as reported, site coordinates; never changes
  Registration registration;
  SensorModel estimated;  ///< what this scan shows about its sensor
  std::optional<ShotGrid> grid;
  bool has_intensity = false;
  bool pinned = false;
  std::string note;
  ScanState state = ScanState::queued;
  std::string failure;  ///< why, when `failed`
  PayloadRef payload;
  std::uint64_t stored_bytes = 0;
};

/// The pose to compute with: registered, relative to the site's origin.
Pose local_pose(const ScanRecord& scan, const Site& site);
/// The pose as reported, relative to the site's origin.
Pose reported_local_pose(const ScanRecord& scan, const Site& site);

/// Stores the record (its `id`, `vantage`, `state` are decided here), makes a vantage if none is near, and fixes the
/// site's origin if this is its first scan (to the scan's position rounded to whole metres if farther than 10 km from
/// zero, else to zero).
/// When the sensor has a scan of that time with the same sha256, nothing is stored and that record comes back; the
/// payload of the argument, which then differs from the record's, is left to the caller to remove.
/// @throws Conflict when the sensor has a scan of that time with another sha256; NotFound; DiskFull.
ScanRecord insert_scan(Transaction& transaction, ScanRecord scan);
std::optional<ScanRecord> find_scan(const Snapshot& snapshot, ScanId id);
std::optional<ScanRecord> find_scan(const Snapshot& snapshot, SensorId sensor, Time captured_at);

struct ScanFilter {
  std::optional<SiteId> site;
  std::optional<SensorId> sensor;
  std::optional<VantageId> vantage;
  std::optional<Time> from, to;           ///< from <= captured_at < to
  std::optional<Eigen::Vector3d> near_m;  ///< local; needs `site`: scans of the vantages within `near_radius_m`
  double near_radius_m = 5.0;
};
/// Newest capture first.
Page<ScanRecord> list_scans(const Snapshot& snapshot, const ScanFilter& filter, const PageRequest& page);

struct ScanEdit {
  std::optional<bool> pinned;
  std::optional<std::string> note;
};
ScanRecord edit_scan(Transaction& transaction, ScanId id, const ScanEdit& edit);
void set_registration(Transaction& transaction, ScanId id, const Registration& registration);
void set_scan_state(Transaction& transaction, ScanId id, ScanState state, std::string_view failure = {});

/// What the scan's points and the classes in its comparisons take; 0 when it is not there.
std::uint64_t bytes_of_scan(const Snapshot& snapshot, ScanId id);

/// Deletes the record with its comparisons and changes; returns the payloads to remove after the commit.
/// @throws Conflict when it is pinned, being compared, or a prior of a stored comparison.
std::vector<PayloadRef> delete_scan(Transaction& transaction, ScanId id);
/// The same without these checks, for retention, which knows what is still needed. Comparisons with it as a prior stay,
/// with their figures and its id.
std::vector<PayloadRef> drop_scan(Transaction& transaction, const ScanRecord& scan);

Page<Vantage> list_vantages(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);

/// The vantages nearest to a place (local), at most `limit`, nearest first, through the R*Tree.
std::vector<Vantage> nearest_vantages(const Snapshot& snapshot, SiteId site, const Eigen::Vector3d& position_m,
                                      std::size_t limit);
/// The latest scan of a vantage with not_before <= captured_at < before.
std::optional<ScanRecord> latest_scan(const Snapshot& snapshot, VantageId vantage, Time not_before, Time before);
/// The earliest anchor of a vantage: see `Registration`.
std::optional<ScanRecord> find_anchor(const Snapshot& snapshot, VantageId vantage);
/// The latest scan of a sensor before a time whose registration was looked at.
std::optional<ScanRecord> latest_registered(const Snapshot& snapshot, SensorId sensor, Time before);

}  // namespace raywatch
