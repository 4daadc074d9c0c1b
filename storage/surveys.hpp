#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/survey.hpp"
#include "storage/page.hpp"
#include "storage/payloads.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// A stored survey without what it found.
struct SurveyRecord {
  SurveyId id;
  SiteId site;
  std::optional<ScheduleId> schedule;
  RunId run;
  EpochId before, after;
  Time before_at, after_at;  ///< of the first scan of each
  Time made_at;
  PayloadRef models;  ///< see `put_survey`
  std::uint64_t stored_bytes = 0;
};

/// Puts the models of a survey, their difference and what is said of the points into a payload.
PayloadRef put_survey(Payloads& payloads, SiteId site, Time captured_at, const SurveyResult& survey);
/// Puts them back into a survey; the stations of the models are not kept. @throws CorruptData, NotFound.
void read_models(Payloads& payloads, const PayloadRef& ref, SurveyResult& survey);

/// Stores the survey with its figures, but for the models, which are in the payload. Its id is decided here.
SurveyRecord insert_survey(Transaction& transaction, SurveyRecord survey, const SurveyResult& result);
std::optional<SurveyRecord> find_survey(const Snapshot& snapshot, SurveyId id);
/// What it found, without models, points and changes.
SurveyResult survey_result(const Snapshot& snapshot, SurveyId id);
std::vector<SurveyChange> survey_changes(const Snapshot& snapshot, SurveyId id);
/// By kind, then by size.
Page<SurveyChange> survey_changes(const Snapshot& snapshot, SurveyId id, const PageRequest& page);

struct SurveyFilter {
  std::optional<SiteId> site;
  std::optional<ScheduleId> schedule;
};
/// A survey as it stands in a list: its result is without models, points and changes.
struct ListedSurvey {
  SurveyRecord record;
  std::string site;  ///< its name
  SurveyResult result;
};
/// Newest first, in one query. With a schedule the site is not asked about.
Page<ListedSurvey> list_surveys(const Snapshot& snapshot, const SurveyFilter& filter, const PageRequest& page);

}  // namespace raywatch
