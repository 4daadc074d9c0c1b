#pragma once

#include <string>
#include <string_view>

#include "core/survey.hpp"

namespace raywatch {

/// A text as it stands in HTML, also inside of attributes.
std::string escaped(std::string_view text);

/// A number for people, with commas at the thousands: "-1,240.5". What is not finite is "-".
std::string number_text(double value, int decimals);
/// With as many decimals as mean something for a volume, an area or a mass.
std::string amount_text(double value);
/// The same with its sign, also when it is above 0.
std::string signed_text(double value);
std::string percent_text(double share);

/// "between 1,240 and 1,310 m3", with a superscript; of an end that is not known "at least", "at most", or
/// "not bounded".
std::string between_text(double low, double high, std::string_view unit);
std::string between_text(const VolumeFigure& figure);
/// For a unit as `unit_of` gives it: "m³".
std::string_view unit_text(std::string_view unit);
/// "Net, all seen ground".
std::string_view title_of(SurveyFigure figure);

}  // namespace raywatch
