#include "storage/scans.hpp"

#include <cmath>

#include "storage/baselines.hpp"
#include "storage/columns.hpp"
#include "storage/epochs.hpp"
#include "storage/scan_rows.hpp"
#include "storage/sensors.hpp"
#include "storage/snapshot.hpp"
#include "storage/vantages.hpp"

namespace raywatch {
namespace {

ScanRecord existing_scan(const Snapshot& snapshot, ScanId id) {
  std::optional<ScanRecord> scan = find_scan(snapshot, id);
  if (!scan) throw NotFound("there is no scan " + std::to_string(id.value));
  return std::move(*scan);
}

Site site_of(const Snapshot& snapshot, const ScanRecord& scan) {
  std::optional<Site> site = find_site(snapshot, scan.site);
  if (!site) throw NotFound("there is no site " + std::to_string(scan.site.value));
  return std::move(*site);
}

void require_finite(const Pose& pose) {
  if (pose.position_m.allFinite() && pose.orientation.coeffs().allFinite()) return;
  throw InvalidInput("the pose is not finite", {{"pose", "must be finite"}});
}

void require_sensor_of_site(const Snapshot& snapshot, const ScanRecord& scan) {
  const std::optional<Sensor> sensor = find_sensor(snapshot, scan.sensor);
  if (!sensor) throw NotFound("there is no sensor " + std::to_string(scan.sensor.value));
  if (sensor->site != scan.site) throw Conflict("sensor \"" + sensor->name + "\" belongs to another site");
}

/// The stored scan of the same sensor and time, if it has the same bytes.
std::optional<ScanRecord> same_scan(const Snapshot& snapshot, const ScanRecord& scan) {
  std::optional<ScanRecord> stored = find_scan(snapshot, scan.sensor, scan.captured_at);
  if (stored && stored->sha256 != scan.sha256) {
    throw Conflict("the sensor has another scan of " + format_rfc3339(scan.captured_at) + ": scan " +
                   std::to_string(stored->id.value) + ", with other bytes");
  }
  return stored;
}

template <class T, class U>
std::optional<T> member(const std::optional<U>& object, T U::*pointer) {
  return object ? std::optional((*object).*pointer) : std::nullopt;
}

ScanId insert_row(Transaction& transaction, const ScanRecord& scan, VantageId vantage) {
  const PoseBytes pose = pose_bytes(scan.pose);
  const PoseBytes correction = pose_bytes(scan.registration.correction);
  database_of(transaction)
      .run(
          "INSERT INTO scans (site, sensor, vantage, captured_at, received_at, points, sha256, reported_pose, "
          "registration_state, registration_correction, estimated, grid_rows, grid_columns, has_intensity, pinned, "
          "note, state, failure, payload_file, payload_key, stored_bytes) "
          "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, '', ?, ?, ?)",
          scan.site, scan.sensor, vantage, scan.captured_at, scan.received_at, scan.points, scan.sha256, pose,
          to_string(scan.registration.state), correction, model_json(scan.estimated),
          member(scan.grid, &ShotGrid::rows), member(scan.grid, &ShotGrid::columns), scan.has_intensity, scan.pinned,
          scan.note, to_string(ScanState::queued), scan.payload.file, scan.payload.key, scan.stored_bytes);
  const ScanId id{database_of(transaction).last_id()};
  set_registration(transaction, id, scan.registration);
  return id;
}

void require_deletable(const Snapshot& snapshot, const ScanRecord& scan) {
  const std::string name = "scan " + std::to_string(scan.id.value);
  if (scan.pinned) throw Conflict(name + " is pinned");
  Database& database = database_of(snapshot);
  if (database.find<int>(
          "SELECT 1 FROM comparisons INDEXED BY comparisons_by_scan WHERE scan = ? AND state = ? LIMIT 1", scan.id,
          to_string(ComparisonState::running))) {
    throw Conflict(name + " is being compared");
  }
  const auto user = database.find<std::int64_t>(
      "SELECT comparison FROM comparison_priors INDEXED BY comparison_priors_by_scan WHERE scan = ? LIMIT 1", scan.id);
  if (user) throw Conflict(name + " is a prior of comparison " + std::to_string(*user));
  if (is_in_baseline(snapshot, scan.id)) throw Conflict(name + " is part of the baseline of its site");
  if (is_in_accepted_epoch(snapshot, scan.id)) throw Conflict(name + " is part of an accepted epoch of a survey");
}

void delete_comparison(Transaction& transaction, ComparisonId id) {
  Database& database = database_of(transaction);
  database.run(
      "DELETE FROM change_bounds WHERE id IN "
      "(SELECT id FROM changes INDEXED BY changes_by_comparison WHERE comparison = ?)",
      id);
  for (const char* table : {"changes", "comparison_candidates", "comparison_priors", "jobs"}) {
    database.run(std::string("DELETE FROM ") + table + " WHERE comparison = ?", id);
  }
  database.run("DELETE FROM comparisons WHERE id = ?", id);
}

}  // namespace

std::string_view to_string(ScanState state) {
  switch (state) {
    case ScanState::queued:
      return "queued";
    case ScanState::comparing:
      return "comparing";
    case ScanState::compared:
      return "compared";
    case ScanState::failed:
      break;
  }
  return "failed";
}

Pose reported_local_pose(const ScanRecord& scan, const Site& site) {
  Pose local_from_sensor = scan.pose;
  if (site.origin_m) local_from_sensor.position_m -= *site.origin_m;
  return local_from_sensor;
}

Pose local_pose(const ScanRecord& scan, const Site& site) {
  Pose local_from_sensor = scan.registration.correction * scan.pose;
  if (site.origin_m) local_from_sensor.position_m -= *site.origin_m;
  return local_from_sensor;
}

const std::string& select_scans() {
  static const std::string sql =
      "SELECT id, site, sensor, vantage, captured_at, received_at, points, sha256, reported_pose, registration_state, "
      "registration_correction, registration_residual_m, registration_inliers, registration_against, "
      "registration_uncertainty_m, registration_uncertainty_rad, estimated, grid_rows, grid_columns, has_intensity, "
      " pinned, note, state, failure, payload_file, payload_key, stored_bytes FROM scans ";
  return sql;
}

ScanRecord read_scan(Statement& row) {
  ScanRecord scan;
  scan.id = row.take<ScanId>();
  scan.site = row.take<SiteId>();
  scan.sensor = row.take<SensorId>();
  scan.vantage = row.take<VantageId>();
  scan.captured_at = row.take<Time>();
  scan.received_at = row.take<Time>();
  scan.points = row.take<std::uint64_t>();
  scan.sha256 = row.take<std::string>();
  scan.pose = pose_from_bytes(row.take<std::span<const std::uint8_t>>());
  scan.registration.state = enum_from_text(row.take<std::string>(), {RegistrationState::none, RegistrationState::good,
                                                                     RegistrationState::moved, RegistrationState::bad});
  scan.registration.correction = pose_from_bytes(row.take<std::span<const std::uint8_t>>());
  scan.registration.residual_m = row.take<std::optional<double>>();
  scan.registration.inliers = row.take<std::optional<double>>();
  scan.registration.against = row.take<std::optional<ScanId>>();
  const auto uncertainty_m = row.take<std::optional<double>>();
  const auto uncertainty_rad = row.take<std::optional<double>>();
  if (uncertainty_m && uncertainty_rad) scan.registration.uncertainty = {*uncertainty_m, *uncertainty_rad};
  scan.estimated = model_from_json(row.take<std::string>());
  const auto rows = row.take<std::optional<std::uint32_t>>();
  const auto columns = row.take<std::optional<std::uint32_t>>();
  if (rows && columns) scan.grid = ShotGrid{*rows, *columns};
  scan.has_intensity = row.take<bool>();
  scan.pinned = row.take<bool>();
  scan.note = row.take<std::string>();
  scan.state = enum_from_text(row.take<std::string>(),
                              {ScanState::queued, ScanState::comparing, ScanState::compared, ScanState::failed});
  scan.failure = row.take<std::string>();
  scan.payload.file = row.take<std::string>();
  scan.payload.key = row.take<std::int64_t>();
  scan.stored_bytes = row.take<std::uint64_t>();
  return scan;
}

ScanRecord insert_scan(Transaction& transaction, ScanRecord scan) {
  transaction.impl().require_room_for_records();
  require_finite(scan.pose);
  require_sensor_of_site(transaction, scan);
  if (std::optional<ScanRecord> stored = same_scan(transaction, scan)) return std::move(*stored);
  const Site site = fix_origin(transaction, site_of(transaction, scan), scan.pose.position_m);
  const VantageId vantage = vantage_for_scan(transaction, scan.site, local_pose(scan, site).position_m);
  const ScanId id = insert_row(transaction, scan, vantage);
  add_scan_to_vantage(transaction, vantage, scan.captured_at);
  return existing_scan(transaction, id);
}

std::optional<ScanRecord> find_scan(const Snapshot& snapshot, ScanId id) {
  Statement row(database_of(snapshot), select_scans() + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_scan(row);
}

std::optional<ScanRecord> find_scan(const Snapshot& snapshot, SensorId sensor, Time captured_at) {
  Statement row(database_of(snapshot),
                select_scans() + "INDEXED BY scans_by_sensor WHERE sensor = ? AND captured_at = ?");
  if (!row.bind(sensor, captured_at).next()) return std::nullopt;
  return read_scan(row);
}

ScanRecord edit_scan(Transaction& transaction, ScanId id, const ScanEdit& edit) {
  ScanRecord scan = existing_scan(transaction, id);
  scan.pinned = edit.pinned.value_or(scan.pinned);
  scan.note = edit.note.value_or(scan.note);
  database_of(transaction).run("UPDATE scans SET pinned = ?, note = ? WHERE id = ?", scan.pinned, scan.note, id);
  return scan;
}

void set_registration(Transaction& transaction, ScanId id, const Registration& registration) {
  const PoseBytes correction = pose_bytes(registration.correction);
  database_of(transaction)
      .run(
          "UPDATE scans SET registration_state = ?, registration_correction = ?, registration_residual_m = ?, "
          "registration_inliers = ?, registration_against = ?, registration_uncertainty_m = ?, "
          "registration_uncertainty_rad = ? WHERE id = ?",
          to_string(registration.state), correction, registration.residual_m, registration.inliers,
          registration.against, member(registration.uncertainty, &PoseUncertainty::position_m),
          member(registration.uncertainty, &PoseUncertainty::angle_rad), id);
}

void set_scan_state(Transaction& transaction, ScanId id, ScanState state, std::string_view failure) {
  database_of(transaction).run("UPDATE scans SET state = ?, failure = ? WHERE id = ?", to_string(state), failure, id);
}

std::uint64_t bytes_of_scan(const Snapshot& snapshot, ScanId id) {
  return database_of(snapshot)
      .find<std::uint64_t>(
          "SELECT stored_bytes + (SELECT ifnull(sum(stored_bytes), 0) FROM comparisons INDEXED BY comparisons_by_scan "
          "WHERE scan = ?1) FROM scans WHERE id = ?1",
          id)
      .value_or(0);
}

std::vector<PayloadRef> delete_scan(Transaction& transaction, ScanId id) {
  const ScanRecord scan = existing_scan(transaction, id);
  require_deletable(transaction, scan);
  return drop_scan(transaction, scan);
}

std::vector<PayloadRef> drop_scan(Transaction& transaction, const ScanRecord& scan) {
  std::vector<PayloadRef> payloads{scan.payload};
  for (const ComparisonRecord& comparison : comparisons_of(transaction, scan.id)) {
    if (!comparison.payload.file.empty()) payloads.push_back(comparison.payload);
    delete_comparison(transaction, comparison.id);
  }
  database_of(transaction).run("DELETE FROM scans WHERE id = ?", scan.id);
  drop_scan_from_vantage(transaction, scan.vantage);
  return payloads;
}

}  // namespace raywatch
