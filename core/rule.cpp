#include "core/rule.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/names.hpp"

namespace raywatch {
namespace {

constexpr Names<Severity, 4> kSeverities{{{Severity::info, "info"},
                                          {Severity::advisory, "advisory"},
                                          {Severity::warning, "warning"},
                                          {Severity::critical, "critical"}}};
constexpr Names<AlertState, 4> kAlertStates{{{AlertState::open, "open"},
                                             {AlertState::acknowledged, "acknowledged"},
                                             {AlertState::snoozed, "snoozed"},
                                             {AlertState::resolved, "resolved"}}};

const Zone* find_zone(std::span<const Zone> zones, ZoneId id) {
  const auto found = std::find_if(zones.begin(), zones.end(), [&](const Zone& zone) { return zone.id == id; });
  return found == zones.end() ? nullptr : &*found;
}

bool lies_in_zone_with(const Change& change, std::span<const Zone> zones, ZoneId id) {
  const Zone* zone = find_zone(zones, id);
  return zone != nullptr && lies_in(change, *zone);
}

bool is_of_kind(const Rule& rule, ChangeKind kind) {
  return (kind == ChangeKind::added && rule.added) || (kind == ChangeKind::removed && rule.removed);
}

bool is_large_enough(const Rule& rule, const Change& change) {
  return change.points >= rule.min_points && change.volume_m3 >= rule.min_volume_m3 &&
         change.box.size_m.maxCoeff() >= rule.min_extent_m;
}

bool lasts(const Persistence& persistence, const Track& track) {
  const std::chrono::duration<double> age = between(track.first_seen_at, track.last_seen_at);
  return seen_of_last(track, persistence.of) >= persistence.scans && age.count() >= persistence.seconds;
}

bool is_silenced(const Track& track, const JudgedScan& scan, const Rulebook& book) {
  return std::any_of(book.silences.begin(), book.silences.end(), [&](const Silence& silence) {
    if (scan.at < silence.from || scan.at >= silence.until) return false;
    if (silence.sensor && *silence.sensor != scan.sensor) return false;
    return !silence.zone || lies_in_zone_with(track.latest, book.zones, *silence.zone);
  });
}

std::optional<AlertStep> judge_seen(const JudgedScan& scan, const Track& track, const Rule& rule, const Rulebook& book,
                                    const StandingAlert* alert) {
  using enum AlertStep::Kind;
  const bool stands = alert != nullptr && alert->state != AlertState::resolved;
  const bool may_come = alert == nullptr || alert->resolved_as_gone;
  if (!stands && !may_come) return std::nullopt;
  if (!raises(rule, track, scan, book)) return std::nullopt;
  AlertStep step{.track = track.id, .rule = rule.id, .severity = rule.severity};
  if (alert == nullptr) return step;
  step.alert = alert->id;
  step.severity = std::max(alert->severity, rule.severity);
  if (!stands) {
    step.kind = reopen;
    return step;
  }
  step.kind = raise;
  return rule.severity > alert->severity ? std::optional(step) : std::nullopt;
}

}  // namespace

std::string_view to_string(Severity severity) { return name_of(kSeverities, severity); }
Severity parse_severity(std::string_view name) { return value_of(kSeverities, name, "severity"); }
std::string_view to_string(AlertState state) { return name_of(kAlertStates, state); }
AlertState parse_alert_state(std::string_view name) { return value_of(kAlertStates, name, "state"); }

void check_rule(const Rule& rule) {
  std::vector<FieldError> errors;
  const auto require = [&](bool holds, const char* field, const char* message) {
    if (!holds) errors.push_back({field, message});
  };
  const Persistence& p = rule.persistence;
  require(rule.added || rule.removed, "kinds", "must name at least one of added, removed");
  require(p.scans >= 1 && p.scans <= p.of, "persistence.scans", "must be from 1 to persistence.of");
  require(p.of <= kRememberedSights, "persistence.of", "must be at most 64");
  require(std::isfinite(p.seconds) && p.seconds >= 0.0, "persistence.seconds", "must be 0 or more");
  require(std::isfinite(rule.min_volume_m3) && rule.min_volume_m3 >= 0.0, "min_volume_m3", "must be 0 or more");
  require(std::isfinite(rule.min_extent_m) && rule.min_extent_m >= 0.0, "min_extent_m", "must be 0 or more");
  if (!errors.empty()) throw InvalidInput("The rule cannot work.", std::move(errors));
}

bool lies_in(const Change& change, const Zone& zone) {
  return contains(zone.prism, change.centroid_m) || share_inside(zone.prism, change.box) >= kShareInZone;
}

bool lies_in_any(const Change& change, std::span<const Zone> zones, ZoneKind kind) {
  return std::any_of(zones.begin(), zones.end(),
                     [&](const Zone& zone) { return zone.kind == kind && lies_in(change, zone); });
}

bool raises(const Rule& rule, const Track& track, const JudgedScan& scan, const Rulebook& book) {
  return rule.enabled && is_of_kind(rule, track.kind) && is_large_enough(rule, track.latest) &&
         lasts(rule.persistence, track) && holds_at(rule.schedule, scan.local) &&
         (!rule.zone || lies_in_zone_with(track.latest, book.zones, *rule.zone)) &&
         !lies_in_any(track.latest, book.zones, ZoneKind::ignore) && !is_silenced(track, scan, book);
}

std::vector<AlertStep> judge(const JudgedScan& scan, std::span<const TrackSight> tracks, const Rulebook& book,
                             std::span<const StandingAlert> alerts) {
  std::vector<AlertStep> steps;
  for (const auto& [track, sight] : tracks) {
    if (sight == Sight::seen) {
      for (const Rule& rule : book.rules) {
        const auto alert = std::find_if(alerts.begin(), alerts.end(), [&](const StandingAlert& standing) {
          return standing.track == track.id && standing.rule == rule.id;
        });
        if (auto step = judge_seen(scan, track, rule, book, alert == alerts.end() ? nullptr : &*alert)) {
          steps.push_back(*step);
        }
      }
    } else if (sight == Sight::absent) {
      for (const StandingAlert& alert : alerts) {
        if (alert.track != track.id || alert.state == AlertState::resolved || !alert.auto_resolve) continue;
        steps.push_back({.kind = AlertStep::Kind::resolve,
                         .track = track.id,
                         .rule = alert.rule,
                         .alert = alert.id,
                         .severity = alert.severity});
      }
    }
  }
  return steps;
}

}  // namespace raywatch
