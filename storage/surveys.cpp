#include "storage/surveys.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "storage/cursor.hpp"
#include "storage/snapshot.hpp"
#include "storage/survey_json.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kSurveyList = "surveys", kSurveyChangeList = "survey_changes";
const std::string kSurveyColumns =
    "SELECT id, site, schedule, run, before_epoch, after_epoch, before_at, after_at, made_at, payload_file, "
    "payload_key, stored_bytes";

SurveyRecord read_survey(Statement& row) {
  SurveyRecord survey;
  survey.id = row.take<SurveyId>();
  survey.site = row.take<SiteId>();
  survey.schedule = row.take<std::optional<ScheduleId>>();
  survey.run = row.take<RunId>();
  survey.before = row.take<EpochId>();
  survey.after = row.take<EpochId>();
  survey.before_at = row.take<Time>();
  survey.after_at = row.take<Time>();
  survey.made_at = row.take<Time>();
  survey.models.file = row.take<std::string>();
  survey.models.key = row.take<std::int64_t>();
  survey.stored_bytes = row.take<std::uint64_t>();
  return survey;
}

void insert_figures(Transaction& transaction, const SurveyRecord& survey, const ZoneFigures& figures, ZoneId zone) {
  for (std::size_t i = 0; i < kSurveyFigures; ++i) {
    const auto figure = static_cast<SurveyFigure>(i);
    const std::optional<FigureValue> value = value_of(figures, figure);
    if (!value) continue;
    database_of(transaction)
        .run("INSERT INTO survey_figures VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, NULL)", survey.id, zone, to_string(figure),
             survey.site, survey.schedule.value_or(ScheduleId{0}), survey.after_at, value->value, value->low,
             value->high);
  }
}

/// One text of a survey that is there.
std::string text_of(const Snapshot& snapshot, SurveyId id, const char* column) {
  const auto text =
      database_of(snapshot).find<std::string>(std::string("SELECT ") + column + " FROM surveys WHERE id = ?", id);
  if (!text) throw NotFound("survey " + std::to_string(id.value) + " does not exist");
  return *text;
}

}  // namespace

SurveyRecord insert_survey(Transaction& transaction, SurveyRecord survey, const SurveyResult& result) {
  transaction.impl().require_room_for_records();
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO surveys (site, schedule, run, before_epoch, after_epoch, before_at, after_at, made_at, result, "
      "changes, payload_file, payload_key, stored_bytes) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      survey.site, survey.schedule, survey.run, survey.before, survey.after, survey.before_at, survey.after_at,
      survey.made_at, result_json(result), changes_json(result.changes), survey.models.file, survey.models.key,
      survey.stored_bytes);
  survey.id = SurveyId{database.last_id()};
  insert_figures(transaction, survey, result.total, ZoneId{0});
  for (const ZoneFigures& figures : result.zones) {
    if (figures.zone.zone) insert_figures(transaction, survey, figures, *figures.zone.zone);
  }
  return survey;
}

std::optional<SurveyRecord> find_survey(const Snapshot& snapshot, SurveyId id) {
  Statement row(database_of(snapshot), kSurveyColumns + " FROM surveys WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_survey(row);
}

SurveyResult survey_result(const Snapshot& snapshot, SurveyId id) {
  return result_from_json(text_of(snapshot, id, "result"));
}

std::vector<SurveyChange> survey_changes(const Snapshot& snapshot, SurveyId id) {
  return changes_from_json(text_of(snapshot, id, "changes"));
}

Page<SurveyChange> survey_changes(const Snapshot& snapshot, SurveyId id, const PageRequest& page) {
  const auto [done] = key_before<1>(page, kSurveyChangeList, {0});
  std::vector<SurveyChange> all = survey_changes(snapshot, id);
  const auto first = std::min(static_cast<std::size_t>(std::max<std::int64_t>(done, 0)), all.size());
  const std::size_t last = std::min(first + checked_limit(page), all.size());
  Page<SurveyChange> result{
      {all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(last)},
      std::nullopt};
  if (last < all.size()) result.next = encode_cursor(kSurveyChangeList, std::array{static_cast<std::int64_t>(last)});
  return result;
}

Page<ListedSurvey> list_surveys(const Snapshot& snapshot, const SurveyFilter& filter, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kSurveyList, {std::numeric_limits<std::int64_t>::max()});
  const std::string which = filter.schedule ? "INDEXED BY surveys_by_schedule WHERE schedule = ? AND "
                            : filter.site   ? "INDEXED BY surveys_by_site WHERE site = ? AND "
                                            : "WHERE ";
  const std::string site_name = ", (SELECT name FROM sites WHERE sites.id = surveys.site)";
  Statement rows(database_of(snapshot),
                 kSurveyColumns + site_name + ", result FROM surveys " + which + "id < ? ORDER BY id DESC LIMIT ?");
  if (filter.schedule) {
    rows.bind(*filter.schedule);
  } else if (filter.site) {
    rows.bind(*filter.site);
  }
  rows.bind(before, rows_to_read(page));
  std::vector<ListedSurvey> surveys;
  while (rows.next()) {
    ListedSurvey& survey = surveys.emplace_back();
    survey.record = read_survey(rows);
    survey.site = rows.take<std::string>();
    survey.result = result_from_json(rows.take<std::string>());
  }
  return make_page(std::move(surveys), page, kSurveyList,
                   [](const ListedSurvey& survey) { return std::array{survey.record.id.value}; });
}

}  // namespace raywatch
