#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/schedule.hpp"
#include "core/track.hpp"
#include "core/zone.hpp"

namespace raywatch {

/// How bad an alert is; in rising order.
enum class Severity : std::uint8_t { info, advisory, warning, critical };
std::string_view to_string(Severity severity);
/// @throws InvalidInput naming the known ones.
Severity parse_severity(std::string_view name);

/// What must last before it is told: seen in `scans` of the last `of` scans that could see the place, and for at least
/// so many seconds from the first to the latest sight.
struct Persistence {
  std::uint32_t scans = 1;
  std::uint32_t of = 1;
  double seconds = 0.0;
};

/// Which changes raise alerts.
struct Rule {
  RuleId id;
  std::optional<ZoneId> zone;  ///< only what lies in it; not given: anywhere
  bool added = true, removed = true;
  std::uint64_t min_points = 0;
  double min_volume_m3 = 0.0;
  double min_extent_m = 0.0;  ///< of the longest side
  Persistence persistence;
  Severity severity = Severity::warning;
  Schedule schedule;  ///< in the site's time
  bool enabled = true;
  bool auto_resolve = true;  ///< its alerts resolve by themselves when the change is gone
};

/// @throws InvalidInput naming what is out of its range: 1 <= scans <= of <= 64, nothing negative, at least one kind.
void check_rule(const Rule& rule);

/// A zone as rules see it.
struct Zone {
  ZoneId id;
  ZoneKind kind = ZoneKind::alert;
  Prism prism;
};

bool lies_in(const Change& change, const Zone& zone);
bool lies_in_any(const Change& change, std::span<const Zone> zones, ZoneKind kind);

/// Planned work: from one moment until another no alert is raised by what lies in a zone, by what a sensor sees, or,
/// when neither is given, at all.
struct Silence {
  std::optional<ZoneId> zone;
  std::optional<SensorId> sensor;
  Time from, until;
};

/// The scan by which tracks are judged.
struct JudgedScan {
  Time at;
  LocalMoment local;  ///< the same in the site's time
  SensorId sensor;
};

/// Everything that decides whether a track raises an alert, but for the track itself.
struct Rulebook {
  std::vector<Rule> rules;
  std::vector<Zone> zones;
  std::vector<Silence> silences;
};

/// Whether a rule asks for an alert about a track that this scan saw.
bool raises(const Rule& rule, const Track& track, const JudgedScan& scan, const Rulebook& book);

enum class AlertState : std::uint8_t { open, acknowledged, snoozed, resolved };
std::string_view to_string(AlertState state);
/// @throws InvalidInput naming the known ones.
AlertState parse_alert_state(std::string_view name);

/// An alert that stands already; one a track and rule.
struct StandingAlert {
  AlertId id;
  TrackId track;
  RuleId rule;
  AlertState state = AlertState::open;
  Severity severity = Severity::warning;
  bool auto_resolve = true;
  bool resolved_as_gone = false;  ///< it resolved by itself
};

/// What becomes of alerts when a scan was seen.
struct AlertStep {
  enum class Kind : std::uint8_t {
    open,     ///< a new one
    reopen,   ///< it had resolved by itself, and is so again
    raise,    ///< its severity rises
    resolve,  ///< the change is gone
  } kind = Kind::open;
  TrackId track;
  RuleId rule;
  std::optional<AlertId> alert;  ///< of an alert that stands
  Severity severity = Severity::warning;
};

/// Judges the tracks that a scan told something about, each with what it showed. For one track and one rule there is
/// never more than one alert. A pure function: the same history gives the same alerts, whenever it is judged.
struct TrackSight {
  const Track& track;
  Sight sight = Sight::seen;
};
std::vector<AlertStep> judge(const JudgedScan& scan, std::span<const TrackSight> tracks, const Rulebook& book,
                             std::span<const StandingAlert> alerts);

}  // namespace raywatch
