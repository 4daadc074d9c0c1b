#pragma once

#include <string>
#include <vector>

#include "core/survey.hpp"
#include "storage/schedules.hpp"
#include "storage/survey_runs.hpp"

namespace raywatch {

// JSON texts of the tables of surveys, as in columns.hpp: reading throws CorruptData when the text is not what was
// written. Numbers that are not finite, which some figures are, stand as null.
std::string plan_json(const SchedulePlan& plan);
SchedulePlan plan_from_json(const std::string& text);
std::string definition_json(const SurveyDefinition& definition);
SurveyDefinition definition_from_json(const std::string& text);
std::string log_json(const std::vector<RunLogLine>& log);
std::vector<RunLogLine> log_from_json(const std::string& text);
/// Without changes, models and points.
std::string result_json(const SurveyResult& result);
SurveyResult result_from_json(const std::string& text);
std::string changes_json(const std::vector<SurveyChange>& changes);
std::vector<SurveyChange> changes_from_json(const std::string& text);

}  // namespace raywatch
