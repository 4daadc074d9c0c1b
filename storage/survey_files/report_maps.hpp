#pragma once

#include <string>

#include "storage/survey_files/survey_document.hpp"

namespace raywatch {

/// The maps of a report with their legends, as HTML: difference, ground of both epochs, what was seen.
std::string report_maps(const SurveyDocument& document);

}  // namespace raywatch
