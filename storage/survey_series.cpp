#include "storage/survey_series.hpp"

#include <algorithm>

#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

ZoneId place_of(std::optional<ZoneId> zone) { return zone.value_or(ZoneId{0}); }

}  // namespace

std::vector<SeriesValue> survey_series(const Snapshot& snapshot, const SeriesKey& key, Time from, Time to,
                                       std::size_t most) {
  Statement rows(database_of(snapshot),
                 "SELECT survey, after_at, value, low, high, level FROM survey_figures INDEXED BY "
                 "survey_figures_by_series WHERE site = ? AND schedule = ? AND zone = ? AND figure = ? AND "
                 "after_at >= ? AND after_at < ? ORDER BY after_at DESC, survey DESC LIMIT ?");
  rows.bind(key.site, key.schedule.value_or(ScheduleId{0}), place_of(key.zone), to_string(key.figure), from, to, most);
  std::vector<SeriesValue> values;
  while (rows.next()) {
    SeriesValue& value = values.emplace_back();
    value.survey = rows.take<SurveyId>();
    value.at = rows.take<Time>();
    value.figure.value = rows.take<double>();
    value.figure.low = rows.take<std::optional<double>>();
    value.figure.high = rows.take<std::optional<double>>();
    if (const auto level = rows.take<std::optional<std::string>>()) value.level = parse_level(*level);
  }
  std::ranges::reverse(values);
  return values;
}

LevelState level_of(const Snapshot& snapshot, ScheduleId schedule, std::optional<ZoneId> zone, SurveyFigure figure) {
  Statement row(database_of(snapshot),
                "SELECT level, pending, count FROM survey_levels WHERE schedule = ? AND zone = ? AND figure = ?");
  if (!row.bind(schedule, place_of(zone), to_string(figure)).next()) return {};
  LevelState state;
  state.level = parse_level(row.take<std::string>());
  state.pending = parse_level(row.take<std::string>());
  state.count = row.take<std::uint32_t>();
  return state;
}

void set_level(Transaction& transaction, ScheduleId schedule, const FigureThresholds& judged, const LevelState& state,
               SurveyId survey) {
  Database& database = database_of(transaction);
  const ZoneId zone = place_of(judged.zone);
  database.run("INSERT OR REPLACE INTO survey_levels VALUES (?, ?, ?, ?, ?, ?)", schedule, zone,
               to_string(judged.figure), to_string(state.level), to_string(state.pending), state.count);
  database.run("UPDATE survey_figures SET level = ? WHERE survey = ? AND zone = ? AND figure = ?",
               to_string(state.level), survey, zone, to_string(judged.figure));
}

}  // namespace raywatch
