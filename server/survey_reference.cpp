#include "server/survey_reference.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "core/error.hpp"
#include "server/system_alerts.hpp"
#include "storage/local_time.hpp"
#include "storage/zones.hpp"

namespace raywatch {
namespace {

/// The same time of the clocks so many days before.
Time days_before(Time at, std::uint32_t days, const ZoneClock& zone) {
  return zone.to_utc(zone.to_local(at) - std::chrono::days(days));
}

SurveyZone survey_zone(const ZoneRecord& zone) {
  return {.zone = zone.zone.id, .name = zone.name, .prism = zone.zone.prism};
}

std::string centimetres(double metres) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f cm", 100.0 * metres);
  return text;
}

/// What is wrong with the registration of one scan; empty when nothing is.
std::string misfit_of(const ScanRecord& scan, const RegistrationTolerance& tolerance) {
  const Registration& registration = scan.registration;
  if (registration.state == RegistrationState::bad) return "does not fit onto the earlier ones";
  if (registration.residual_m.value_or(0.0) > tolerance.residual_m) {
    return "fits onto the earlier ones with a residual of " + centimetres(*registration.residual_m) + "; at most " +
           centimetres(tolerance.residual_m) + " is tolerated";
  }
  if (!registration.uncertainty) return {};
  if (registration.uncertainty->position_m > tolerance.uncertainty.position_m) {
    return "has a position that is uncertain by " + centimetres(registration.uncertainty->position_m) + "; at most " +
           centimetres(tolerance.uncertainty.position_m) + " is tolerated";
  }
  if (registration.uncertainty->angle_rad > tolerance.uncertainty.angle_rad) {
    char text[120];
    std::snprintf(text, sizeof text, "has an orientation that is uncertain by %.4f degrees; at most %.4f is tolerated",
                  registration.uncertainty->angle_rad * 180.0 / std::numbers::pi,
                  tolerance.uncertainty.angle_rad * 180.0 / std::numbers::pi);
    return text;
  }
  return {};
}

}  // namespace

std::optional<EpochRecord> reference_epoch(const Snapshot& snapshot, const RunRecord& run, const Site& site) {
  const SurveyReference& reference = run.definition.reference;
  if (const auto named = run.reference ? run.reference : reference.epoch) {
    std::optional<EpochRecord> epoch = find_epoch(snapshot, *named);
    if (!epoch)
      throw NotFound("The epoch " + std::to_string(named->value) + " to compare with does not exist any more.");
    return epoch;
  }
  EpochSearch search{.site = run.site, .schedule = run.schedule, .until = run.from};
  if (reference.policy == ReferencePolicy::accepted) {
    search.schedule = std::nullopt;
    search.accepted = true;
  }
  if (reference.policy == ReferencePolicy::days_ago) {
    const ZoneClock zone = zone_clock(site.time_zone);
    search.until = days_before(run.to, reference.days, zone);
    search.from = days_before(run.from, reference.days, zone);
  }
  return latest_epoch(snapshot, search);
}

std::vector<ScanRecord> scans_with(const Snapshot& snapshot, const EpochRecord& epoch) {
  std::vector<ScanRecord> scans;
  for (const ScanId id : epoch.scans) {
    std::optional<ScanRecord> scan = find_scan(snapshot, id);
    if (!scan) {
      throw NotFound("Scan " + std::to_string(id.value) + " of the epoch \"" + epoch.name + "\" was deleted.");
    }
    scans.push_back(std::move(*scan));
  }
  return scans;
}

std::vector<SurveyZone> survey_zones(const Snapshot& snapshot, const RunRecord& run) {
  std::vector<SurveyZone> zones;
  for (const ZoneId id : run.definition.zones) {
    const std::optional<ZoneRecord> zone = find_zone(snapshot, id);
    if (!zone || zone->site != run.site) {
      throw NotFound("The zone " + std::to_string(id.value) + " does not exist any more; change the schedule.");
    }
    if (zone->zone.kind != ZoneKind::volume) {
      throw InvalidInput("The zone \"" + zone->name + "\" is not of the kind \"volume\"; change it or the schedule.");
    }
    zones.push_back(survey_zone(*zone));
  }
  if (!run.definition.zones.empty()) return zones;
  for (const Zone& zone : zones_of(snapshot, run.site)) {
    if (zone.kind == ZoneKind::volume) zones.push_back(survey_zone(find_zone(snapshot, zone.id).value()));
  }
  return zones;
}

EpochRecord epoch_of_run(const RunRecord& run, const Site& site, const std::vector<ScanRecord>& scans) {
  EpochRecord epoch;
  epoch.site = run.site;
  epoch.schedule = run.schedule;
  epoch.name = local_text(run.due_at, site.time_zone);
  epoch.from = run.from;
  epoch.to = run.to;
  for (const ScanRecord& scan : scans) epoch.scans.push_back(scan.id);
  return epoch;
}

std::string what_is_missing(const Snapshot& snapshot, const std::vector<ScanRecord>& scans,
                            const std::optional<ScheduleRecord>& schedule) {
  if (scans.empty()) return "There are no scans in its window.";
  if (!schedule) return {};
  for (const SensorId sensor : schedule->plan.required_sensors) {
    if (std::ranges::find(scans, sensor, &ScanRecord::sensor) == scans.end()) {
      return "There is no scan of the sensor " + sensor_name(snapshot, sensor) + " in its window.";
    }
  }
  for (const VantageId vantage : schedule->plan.required_vantages) {
    if (std::ranges::find(scans, vantage, &ScanRecord::vantage) == scans.end()) {
      return "There is no scan from the vantage " + std::to_string(vantage.value) + " in its window.";
    }
  }
  return {};
}

std::string what_is_misplaced(const std::vector<ScanRecord>& scans, const RegistrationTolerance& tolerance) {
  for (const ScanRecord& scan : scans) {
    const std::string misfit = misfit_of(scan, tolerance);
    if (!misfit.empty()) return "Scan " + std::to_string(scan.id.value) + " " + misfit + ".";
  }
  return {};
}

}  // namespace raywatch
