#pragma once

#include <iosfwd>

#include "storage/survey_files/survey_document.hpp"

namespace raywatch {

/// A row a change: place and size in the output's coordinates, points, confidence, its volume with the interval of
/// 95 %, and the zones in which it lies. What is not known is empty.
void write_changes_csv(std::ostream& out, const SurveyDocument& document);
/// A row a zone, and one for the total: every figure with its interval or bounds.
void write_zones_csv(std::ostream& out, const SurveyDocument& document);

}  // namespace raywatch
