#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/ids.hpp"
#include "core/pose.hpp"
#include "core/sensor.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// What takes scans. `known` is what was given; `estimated` is what its scans showed; `merged(known, estimated)` is
/// what comparisons use.
struct Sensor {
  SensorId id;
  std::string name;
  SiteId site;
  std::optional<Pose>
      pose;  ///< world_from_sensor of a fixed sensor, as given (site coordinates, origin not subtracted)
  SensorModel known;
  SensorModel estimated;
  std::optional<double> interval_s;
  Time created_at;
};

/// Replaces what `PATCH` may change; the outer optional says "given", an inner one may clear.
struct SensorEdit {
  std::optional<std::optional<Pose>> pose;
  std::optional<SensorModel> known;  ///< all of it, already merged with what stays
  std::optional<std::optional<double>> interval_s;
};

/// `id` and `created_at` of the argument are ignored. @throws Conflict when the name is taken (in any site).
Sensor insert_sensor(Transaction& transaction, const Sensor& sensor, Time now);
std::optional<Sensor> find_sensor(const Snapshot& snapshot, std::string_view name);
std::optional<Sensor> find_sensor(const Snapshot& snapshot, SensorId id);
Page<Sensor> list_sensors(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);
Sensor edit_sensor(Transaction& transaction, SensorId id, const SensorEdit& edit);
void set_estimated_model(Transaction& transaction, SensorId id, const SensorModel& estimated);
/// @throws Conflict while it has scans.
void delete_sensor(Transaction& transaction, SensorId id);

}  // namespace raywatch
