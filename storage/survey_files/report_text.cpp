#include "storage/survey_files/report_text.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace raywatch {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string number_text(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, std::abs(value));
  std::string digits = buffer.data();
  const bool negative = value < 0.0 && digits.find_first_of("123456789") != std::string::npos;
  const std::size_t point = std::min(digits.find('.'), digits.size());
  for (std::size_t at = point; at > 3; at -= 3) digits.insert(at - 3, ",");
  return (negative ? "\u2212" : "") + digits;
}

std::string amount_text(double value) {
  const double size = std::abs(value);
  return number_text(value, size >= 100.0 ? 0 : size >= 10.0 ? 1 : 2);
}

std::string signed_text(double value) { return (value > 0.0 ? "+" : "") + amount_text(value); }

std::string percent_text(double share) { return number_text(100.0 * share, 1) + "\u00a0%"; }

std::string between_text(double low, double high, std::string_view unit) {
  const std::string after = "\u00a0" + std::string(unit);
  if (!std::isfinite(low) && !std::isfinite(high)) return "not bounded";
  if (!std::isfinite(low)) return "at most " + amount_text(high) + after;
  if (!std::isfinite(high)) return "at least " + amount_text(low) + after;
  // Both ends with the decimals of the larger one.
  const int decimals = std::max(std::abs(low), std::abs(high)) >= 100.0 ? 0 : 1;
  return "between " + number_text(low, decimals) + " and " + number_text(high, decimals) + after;
}

std::string between_text(const VolumeFigure& figure) { return between_text(figure.low_m3(), figure.high_m3(), "m³"); }

std::string_view unit_text(std::string_view unit) {
  if (unit == "m3") return "m³";
  if (unit == "m2") return "m²";
  return unit;
}

std::string_view title_of(SurveyFigure figure) {
  switch (figure) {
    case SurveyFigure::cut_m3:
      return "Cut";
    case SurveyFigure::fill_m3:
      return "Fill";
    case SurveyFigure::net_m3:
      return "Net, all seen ground";
    case SurveyFigure::changed_net_m3:
      return "Net, changed ground";
    case SurveyFigure::changed_area_m2:
      return "Changed area";
    case SurveyFigure::greatest_rise_m:
      return "Greatest rise";
    case SurveyFigure::greatest_fall_m:
      return "Greatest fall";
    case SurveyFigure::mean_change_m:
      return "Mean change";
    case SurveyFigure::m3c2_greatest_m:
      return "Greatest change along the normal";
    case SurveyFigure::m3c2_mean_m:
      return "Mean change along the normal";
    case SurveyFigure::seen_share:
      return "Seen in both epochs";
  }
  return "";
}

}  // namespace raywatch
