#include "server/survey_alerts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "server/system_alerts.hpp"
#include "storage/alerts.hpp"
#include "storage/survey_series.hpp"

namespace raywatch {
namespace {

SystemSubject subject_of(const ScheduleRecord& schedule, const char* cause) {
  return {.site = schedule.site, .cause = cause, .subject = schedule.name, .zone = {}, .sensor = {}};
}

constexpr const char* kMissing = "survey-missing";
constexpr const char* kRefused = "survey-refused";
constexpr const char* kFailed = "survey-failed";

const char* cause_of(RunState state) {
  switch (state) {
    case RunState::no_scans:
      return kMissing;
    case RunState::refused:
      return kRefused;
    case RunState::failed:
      return kFailed;
    default:
      return nullptr;
  }
}

Severity severity_of(Level level) {
  switch (level) {
    case Level::green:
      return Severity::info;
    case Level::yellow:
      return Severity::advisory;
    case Level::orange:
      return Severity::warning;
    case Level::red:
      break;
  }
  return Severity::critical;
}

/// The figures that thresholds are about, if the survey has them.
const ZoneFigures* figures_of(const SurveyResult& result, const FigureThresholds& given) {
  if (!given.zone) return &result.total;
  const auto found =
      std::ranges::find_if(result.zones, [&](const ZoneFigures& z) { return z.zone.zone == given.zone; });
  return found == result.zones.end() ? nullptr : &*found;
}

std::string sentence_of(const ScheduleRecord& schedule, const ZoneFigures& figures, const FigureThresholds& given,
                        double value, Level level) {
  char number[40];
  std::snprintf(number, sizeof number, "%.4g", value);
  const std::string unit(unit_of(given.figure));
  return "Survey \"" + schedule.name + "\", " + figures.zone.name + ": " + std::string(to_string(given.figure)) +
         " is " + number + (unit.empty() ? "" : " " + unit) + ", level " + std::string(to_string(level)) + ".";
}

/// What a level became, and of what.
struct LevelNews {
  SystemSubject subject;
  Level before, after;
  std::string sentence;
  std::optional<ScanId> scan;
};

void tell(Transaction& transaction, const LevelNews& news, Time now) {
  if (news.before == news.after) return;
  if (news.after == Level::green) {
    return settle_system_alert(transaction, news.subject, news.sentence, news.scan, now);
  }
  const auto standing = standing_alert(transaction, news.subject.site, news.subject.cause, news.subject.subject);
  const Severity severity = severity_of(news.after);
  if (!standing) {
    return raise_system_alert(transaction, news.subject,
                              {.severity = severity, .scan = news.scan, .at = now, .title = news.sentence});
  }
  change_alert(transaction, standing->id,
               {.action = news.after > news.before ? "raised" : "lowered",
                .by = std::string(kProgram),
                .note = news.sentence,
                .at = now,
                .state = {},
                .severity = severity,
                .snoozed_until = {},
                .scan = news.scan});
}

}  // namespace

void report_run(Transaction& transaction, const ScheduleRecord& schedule, const RunEnd& end, Time now) {
  if (const char* cause = cause_of(end.state)) {
    raise_system_alert(transaction, subject_of(schedule, cause),
                       {.severity = Severity::warning,
                        .scan = {},
                        .at = now,
                        .title = "Survey \"" + schedule.name + "\" brought no result: " + end.why});
    return;
  }
  for (const char* cause : {kMissing, kRefused, kFailed}) {
    settle_system_alert(transaction, subject_of(schedule, cause), "A later run was good.", std::nullopt, now);
  }
}

void judge_levels(Transaction& transaction, const ScheduleRecord& schedule, const SurveyRecord& survey,
                  const SurveyResult& result, Time now) {
  for (const FigureThresholds& given : result.definition.thresholds) {
    const ZoneFigures* figures = figures_of(result, given);
    const std::optional<FigureValue> value = figures ? value_of(*figures, given.figure) : std::nullopt;
    if (!value) continue;
    const LevelState before = level_of(transaction, schedule.id, given.zone, given.figure);
    const LevelState after = next_level(before, std::abs(value->value), given.thresholds);
    set_level(transaction, schedule.id, given, after, survey.id);
    SystemSubject subject = subject_of(schedule, "survey-level");
    subject.subject += "/" + figures->zone.name + "/" + std::string(to_string(given.figure));
    subject.zone = given.zone;
    tell(transaction,
         {.subject = subject,
          .before = before.level,
          .after = after.level,
          .sentence = sentence_of(schedule, *figures, given, value->value, after.level),
          .scan = result.after.front().scan},
         now);
  }
}

}  // namespace raywatch
