#pragma once

#include <string>

#include "storage/survey_files/survey_document.hpp"

namespace raywatch {

/// A report as one HTML file that refers to nothing outside of itself and has no script: style sheet, maps (PNG) and
/// trends (SVG) are inside. Prints on A4. Its style element needs `style-src 'unsafe-inline'` and its maps `img-src
/// data:` in a content security policy.
std::string survey_report(const SurveyDocument& document);

}  // namespace raywatch
