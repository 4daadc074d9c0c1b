#include "storage/sensors.hpp"

#include <array>

#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/sites.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kSensorList = "sensors";
const std::string kSelectSensors =
    "SELECT id, name, site, pose, known, estimated, interval_s, created_at FROM sensors ";

std::optional<Pose> take_pose(Statement& row) {
  const auto bytes = row.take<std::optional<std::span<const std::uint8_t>>>();
  if (!bytes) return std::nullopt;
  return pose_from_bytes(*bytes);
}

std::optional<PoseBytes> optional_pose_bytes(const std::optional<Pose>& pose) {
  return pose ? std::optional(pose_bytes(*pose)) : std::nullopt;
}

Sensor read_sensor(Statement& row) {
  Sensor sensor;
  sensor.id = row.take<SensorId>();
  sensor.name = row.take<std::string>();
  sensor.site = row.take<SiteId>();
  sensor.pose = take_pose(row);
  sensor.known = model_from_json(row.take<std::string>());
  sensor.estimated = model_from_json(row.take<std::string>());
  sensor.interval_s = row.take<std::optional<double>>();
  sensor.created_at = row.take<Time>();
  return sensor;
}

template <class Value>
std::optional<Sensor> find_sensor_by(const Snapshot& snapshot, std::string_view column, const Value& key) {
  Statement row(database_of(snapshot), kSelectSensors + "WHERE " + std::string(column) + " = ?");
  if (!row.bind(key).next()) return std::nullopt;
  return read_sensor(row);
}

Sensor existing_sensor(const Snapshot& snapshot, SensorId id) {
  std::optional<Sensor> sensor = find_sensor(snapshot, id);
  if (!sensor) throw NotFound("there is no sensor " + std::to_string(id.value));
  return std::move(*sensor);
}

}  // namespace

Sensor insert_sensor(Transaction& transaction, const Sensor& sensor, Time now) {
  transaction.impl().require_room_for_records();
  if (find_sensor(transaction, sensor.name)) throw Conflict("there is a sensor named \"" + sensor.name + "\" already");
  if (!find_site(transaction, sensor.site)) throw NotFound("there is no site " + std::to_string(sensor.site.value));
  const std::optional<PoseBytes> pose = optional_pose_bytes(sensor.pose);
  database_of(transaction)
      .run(
          "INSERT INTO sensors (name, site, pose, known, estimated, interval_s, created_at) "
          "VALUES (?, ?, ?, ?, ?, ?, ?)",
          sensor.name, sensor.site, pose, model_json(sensor.known), model_json(sensor.estimated), sensor.interval_s,
          now);
  return existing_sensor(transaction, SensorId{database_of(transaction).last_id()});
}

std::optional<Sensor> find_sensor(const Snapshot& snapshot, std::string_view name) {
  return find_sensor_by(snapshot, "name", name);
}

std::optional<Sensor> find_sensor(const Snapshot& snapshot, SensorId id) { return find_sensor_by(snapshot, "id", id); }

Page<Sensor> list_sensors(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  const auto [after] = key_before<1>(page, kSensorList, {0});
  Statement rows(database_of(snapshot), kSelectSensors +
                                            (site ? "INDEXED BY sensors_by_site WHERE site = ? AND " : "WHERE ") +
                                            "id > ? ORDER BY id LIMIT ?");
  if (site) rows.bind(*site);
  rows.bind(after, rows_to_read(page));
  std::vector<Sensor> sensors;
  while (rows.next()) sensors.push_back(read_sensor(rows));
  return make_page(std::move(sensors), page, kSensorList,
                   [](const Sensor& sensor) { return std::array{sensor.id.value}; });
}

Sensor edit_sensor(Transaction& transaction, SensorId id, const SensorEdit& edit) {
  Sensor sensor = existing_sensor(transaction, id);
  if (edit.pose) sensor.pose = *edit.pose;
  if (edit.known) sensor.known = *edit.known;
  if (edit.interval_s) sensor.interval_s = *edit.interval_s;
  const std::optional<PoseBytes> pose = optional_pose_bytes(sensor.pose);
  database_of(transaction)
      .run("UPDATE sensors SET pose = ?, known = ?, interval_s = ? WHERE id = ?", pose, model_json(sensor.known),
           sensor.interval_s, id);
  return sensor;
}

void set_estimated_model(Transaction& transaction, SensorId id, const SensorModel& estimated) {
  database_of(transaction).run("UPDATE sensors SET estimated = ? WHERE id = ?", model_json(estimated), id);
}

void delete_sensor(Transaction& transaction, SensorId id) {
  const Sensor sensor = existing_sensor(transaction, id);
  if (database_of(transaction).find<int>("SELECT 1 FROM scans WHERE sensor = ? LIMIT 1", id)) {
    throw Conflict("sensor \"" + sensor.name + "\" still has scans");
  }
  database_of(transaction).run("DELETE FROM sensors WHERE id = ?", id);
}

}  // namespace raywatch
