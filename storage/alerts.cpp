#include "storage/alerts.hpp"

#include <array>
#include <limits>

#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/events.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kAlertList = "alerts";
const std::string kSelectAlerts =
    "SELECT id, site, cause, subject, title, state, severity, track, rule, zone, sensor, scan, rule_name, rule_spec, "
    "auto_resolve, resolved_as_gone, opened_at, edited_at, snoozed_until FROM alerts ";

AlertRecord read_alert(Statement& row) {
  AlertRecord alert;
  alert.id = row.take<AlertId>();
  alert.site = row.take<SiteId>();
  alert.cause = row.take<std::string>();
  alert.subject = row.take<std::string>();
  alert.title = row.take<std::string>();
  alert.state = parse_alert_state(row.take<std::string>());
  alert.severity = parse_severity(row.take<std::string>());
  alert.track = row.take<std::optional<TrackId>>();
  alert.rule = row.take<std::optional<RuleId>>();
  alert.zone = row.take<std::optional<ZoneId>>();
  alert.sensor = row.take<std::optional<SensorId>>();
  alert.scan = row.take<std::optional<ScanId>>();
  alert.rule_name = row.take<std::string>();
  alert.rule_then = rule_from_json(row.take<std::string>());
  if (alert.rule) alert.rule_then.id = *alert.rule;
  alert.rule_then.zone = alert.zone;
  alert.auto_resolve = row.take<bool>();
  alert.resolved_as_gone = row.take<bool>();
  alert.opened_at = row.take<Time>();
  alert.edited_at = row.take<Time>();
  alert.snoozed_until = row.take<std::optional<Time>>();
  return alert;
}

std::optional<AlertRecord> one_of(Statement& row) { return row.next() ? std::optional(read_alert(row)) : std::nullopt; }

void add_step(Transaction& transaction, const AlertRecord& alert, const AlertHistoryStep& step) {
  Database& database = database_of(transaction);
  const auto place =
      database.find<std::int64_t>("SELECT ifnull(max(place), -1) + 1 FROM alert_steps WHERE alert = ?", alert.id);
  database.run("INSERT INTO alert_steps VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", alert.id, place, step.at, step.by,
               step.action, step.note, to_string(step.state), to_string(step.severity), step.scan);
  insert_event(transaction, {.at = step.at,
                             .type = "alert." + step.action,
                             .site = alert.site,
                             .scan = step.scan,
                             .track = alert.track,
                             .alert = alert.id,
                             .zone = alert.zone,
                             .rule = alert.rule,
                             .sensor = alert.sensor,
                             .text = alert.title});
}

std::string where(const AlertFilter& filter) {
  const std::string severity = filter.severity ? "severity = ? AND " : "";
  if (filter.site && filter.state) {
    return "INDEXED BY alerts_by_site_and_state WHERE site = ? AND state = ? AND " + severity;
  }
  if (filter.site) return "INDEXED BY alerts_by_site WHERE site = ? AND " + severity;
  if (filter.state) return "INDEXED BY alerts_by_state WHERE state = ? AND " + severity;
  return "WHERE " + severity;
}

}  // namespace

AlertRecord open_alert(Transaction& transaction, const AlertRecord& alert, std::string_view note) {
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO alerts (site, cause, subject, title, state, severity, track, rule, zone, sensor, scan, rule_name, "
      "rule_spec, auto_resolve, resolved_as_gone, opened_at, edited_at) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, 0, ?, ?)",
      alert.site, alert.cause, alert.subject, alert.title, to_string(AlertState::open), to_string(alert.severity),
      alert.track, alert.rule, alert.zone, alert.sensor, alert.scan, alert.rule_name, rule_json(alert.rule_then),
      alert.auto_resolve, alert.opened_at, alert.opened_at);
  AlertRecord stored = find_alert(transaction, AlertId{database.last_id()}).value();
  add_step(transaction, stored,
           {.at = alert.opened_at,
            .by = std::string(kProgram),
            .action = "opened",
            .note = std::string(note),
            .state = AlertState::open,
            .severity = alert.severity,
            .scan = alert.scan});
  return stored;
}

AlertRecord change_alert(Transaction& transaction, AlertId id, const AlertChange& change) {
  std::optional<AlertRecord> found = find_alert(transaction, id);
  if (!found) throw NotFound("there is no alert " + std::to_string(id.value));
  AlertRecord& alert = *found;
  alert.state = change.state.value_or(alert.state);
  alert.severity = change.severity.value_or(alert.severity);
  alert.snoozed_until = alert.state == AlertState::snoozed ? change.snoozed_until : std::nullopt;
  alert.resolved_as_gone = change.resolved_as_gone;
  alert.edited_at = change.at;
  database_of(transaction)
      .run(
          "UPDATE alerts SET state = ?, severity = ?, snoozed_until = ?, resolved_as_gone = ?, edited_at = ? "
          "WHERE id = ?",
          to_string(alert.state), to_string(alert.severity), alert.snoozed_until, alert.resolved_as_gone,
          alert.edited_at, id);
  add_step(transaction, alert,
           {.at = change.at,
            .by = change.by,
            .action = change.action,
            .note = change.note,
            .state = alert.state,
            .severity = alert.severity,
            .scan = change.scan});
  return alert;
}

std::optional<AlertRecord> find_alert(const Snapshot& snapshot, AlertId id) {
  Statement row(database_of(snapshot), kSelectAlerts + "WHERE id = ?");
  row.bind(id);
  return one_of(row);
}

std::vector<AlertHistoryStep> alert_history(const Snapshot& snapshot, AlertId id) {
  Statement rows(database_of(snapshot),
                 "SELECT at, actor, action, note, state, severity, scan FROM alert_steps WHERE alert = ? "
                 "ORDER BY place");
  rows.bind(id);
  std::vector<AlertHistoryStep> steps;
  while (rows.next()) {
    AlertHistoryStep& step = steps.emplace_back();
    step.at = rows.take<Time>();
    step.by = rows.take<std::string>();
    step.action = rows.take<std::string>();
    step.note = rows.take<std::string>();
    step.state = parse_alert_state(rows.take<std::string>());
    step.severity = parse_severity(rows.take<std::string>());
    step.scan = rows.take<std::optional<ScanId>>();
  }
  return steps;
}

Page<AlertRecord> list_alerts(const Snapshot& snapshot, const AlertFilter& filter, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kAlertList, {std::numeric_limits<std::int64_t>::max()});
  Statement rows(database_of(snapshot), kSelectAlerts + where(filter) + "id < ? ORDER BY id DESC LIMIT ?");
  if (filter.site) rows.bind(*filter.site);
  if (filter.state) rows.bind(to_string(*filter.state));
  if (filter.severity) rows.bind(to_string(*filter.severity));
  rows.bind(before, rows_to_read(page));
  std::vector<AlertRecord> alerts;
  while (rows.next()) alerts.push_back(read_alert(rows));
  return make_page(std::move(alerts), page, kAlertList, [](const AlertRecord& a) { return std::array{a.id.value}; });
}

std::vector<AlertRecord> alerts_of(const Snapshot& snapshot, TrackId track) {
  Statement rows(database_of(snapshot), kSelectAlerts + "INDEXED BY alerts_by_track WHERE track = ? ORDER BY rule");
  rows.bind(track);
  std::vector<AlertRecord> alerts;
  while (rows.next()) alerts.push_back(read_alert(rows));
  return alerts;
}

std::optional<AlertRecord> standing_alert(const Snapshot& snapshot, SiteId site, std::string_view cause,
                                          std::string_view subject) {
  Statement row(database_of(snapshot),
                kSelectAlerts +
                    "INDEXED BY alerts_standing WHERE site = ? AND cause = ? AND subject = ? AND track IS NULL "
                    "AND state <> 'resolved'");
  row.bind(site, cause, subject);
  return one_of(row);
}

std::vector<AlertId> snoozed_until(const Snapshot& snapshot, Time now) {
  Statement rows(database_of(snapshot),
                 "SELECT id FROM alerts INDEXED BY alerts_snoozed WHERE state = 'snoozed' AND snoozed_until <= ? "
                 "ORDER BY snoozed_until");
  rows.bind(now);
  std::vector<AlertId> alerts;
  while (rows.next()) alerts.push_back(rows.take<AlertId>());
  return alerts;
}

StandingAlert standing(const AlertRecord& alert) {
  return {.id = alert.id,
          .track = alert.track.value_or(TrackId{}),
          .rule = alert.rule.value_or(RuleId{}),
          .state = alert.state,
          .severity = alert.severity,
          .auto_resolve = alert.auto_resolve,
          .resolved_as_gone = alert.resolved_as_gone};
}

}  // namespace raywatch
