#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/rule.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// The cause of alerts that rules raise; all other causes are those of system alerts.
inline constexpr std::string_view kChangeCause = "change";
/// The actor of what the program does by itself.
inline constexpr std::string_view kProgram = "raywatch";

/// One alert. Of a change: one a track and rule. Of the system: one that stands a cause and subject.
struct AlertRecord {
  AlertId id;
  SiteId site;
  std::string cause{kChangeCause};
  std::string subject;  ///< of a system alert: what it is about
  std::string title;    ///< one sentence for people
  AlertState state = AlertState::open;
  Severity severity = Severity::warning;
  std::optional<TrackId> track;
  std::optional<RuleId> rule;
  std::optional<ZoneId> zone;
  std::optional<SensorId> sensor;
  std::optional<ScanId> scan;  ///< by which it opened
  std::string rule_name;
  Rule rule_then;  ///< as it was when the alert opened
  bool auto_resolve = true;
  bool resolved_as_gone = false;  ///< it resolved by itself, and comes back if its change does
  Time opened_at, edited_at;
  std::optional<Time> snoozed_until;
};

/// One step of an alert's history.
struct AlertHistoryStep {
  Time at;
  std::string by;
  std::string action;  ///< opened, reopened, raised, acknowledged, snoozed, woken, resolved, accepted
  std::string note;
  AlertState state = AlertState::open;  ///< after it
  Severity severity = Severity::warning;
  std::optional<ScanId> scan;
};

/// Stores a new alert with its first step, "opened", and an event. Its id and edited_at are decided here; `opened_at`
/// is that of the step.
AlertRecord open_alert(Transaction& transaction, const AlertRecord& alert, std::string_view note);

/// What happens to an alert that stands.
struct AlertChange {
  std::string action, by, note;
  Time at;
  std::optional<AlertState> state;  ///< not given: as before
  std::optional<Severity> severity;
  std::optional<Time> snoozed_until;  ///< of the state snoozed
  bool resolved_as_gone = false;
  std::optional<ScanId> scan;
};
/// Changes the alert, adds the step and the event "alert.<action>". @throws NotFound.
AlertRecord change_alert(Transaction& transaction, AlertId id, const AlertChange& change);

std::optional<AlertRecord> find_alert(const Snapshot& snapshot, AlertId id);
std::vector<AlertHistoryStep> alert_history(const Snapshot& snapshot, AlertId id);

struct AlertFilter {
  std::optional<SiteId> site;
  std::optional<AlertState> state;
  std::optional<Severity> severity = {};
};
/// Newest first.
Page<AlertRecord> list_alerts(const Snapshot& snapshot, const AlertFilter& filter, const PageRequest& page);
/// All of a track, whatever their state.
std::vector<AlertRecord> alerts_of(const Snapshot& snapshot, TrackId track);
/// The system alert of a cause about a subject that is not resolved.
std::optional<AlertRecord> standing_alert(const Snapshot& snapshot, SiteId site, std::string_view cause,
                                          std::string_view subject);
/// Alerts whose snooze is over.
std::vector<AlertId> snoozed_until(const Snapshot& snapshot, Time now);
/// How judging sees it.
StandingAlert standing(const AlertRecord& alert);

}  // namespace raywatch
