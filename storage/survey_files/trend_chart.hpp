#pragma once

#include <string>

#include "storage/survey_files/survey_document.hpp"

namespace raywatch {

/// A figure through time as an SVG element: values with their intervals of 95 % as bars, the scale at the left, first
/// and last day below, in the site's time zone. Without scripts or references.
std::string trend_chart(const FigureSeries& series, const std::string& time_zone);

}  // namespace raywatch
