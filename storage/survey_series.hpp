#pragma once

#include <optional>
#include <vector>

#include "core/survey.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// Which figure through time.
struct SeriesKey {
  SiteId site;
  std::optional<ScheduleId> schedule;  ///< none: of the surveys by hand
  std::optional<ZoneId> zone;          ///< none: the total
  SurveyFigure figure = SurveyFigure::net_m3;
};

struct SeriesValue {
  SurveyId survey;
  Time at;  ///< of the first scan of the later epoch
  FigureValue figure;
  std::optional<Level> level;  ///< where the schedule has thresholds for it
};

/// In the order of time, from <= at < to; the latest `most` of them.
std::vector<SeriesValue> survey_series(const Snapshot& snapshot, const SeriesKey& key, Time from, Time to,
                                       std::size_t most);

/// The level of a figure of a schedule; green before it was ever judged.
LevelState level_of(const Snapshot& snapshot, ScheduleId schedule, std::optional<ZoneId> zone, SurveyFigure figure);
/// Keeps it, and notes the level at the figure of the survey that was judged.
void set_level(Transaction& transaction, ScheduleId schedule, const FigureThresholds& judged, const LevelState& state,
               SurveyId survey);

}  // namespace raywatch
