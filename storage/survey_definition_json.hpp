#pragma once

#include "core/survey_definition.hpp"
#include "storage/json_values.hpp"

namespace raywatch::json_values {

Json json_of(const SurveyDefinition& definition);
SurveyDefinition definition_of(const Json& json);

}  // namespace raywatch::json_values
