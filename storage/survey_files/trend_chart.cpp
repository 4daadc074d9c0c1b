#include "storage/survey_files/trend_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/local_time.hpp"
#include "storage/survey_files/report_text.hpp"

namespace raywatch {
namespace {

constexpr double kWidth = 340.0, kHeight = 150.0, kLeft = 58.0, kRight = 10.0, kTop = 12.0, kBottom = 26.0;

std::string place(double value) {
  const auto tenths = std::lround(10.0 * value);
  return std::to_string(tenths / 10) + "." + std::to_string(std::abs(tenths % 10));
}

/// A step of 1, 2 or 5 times a power of ten, about a third of the range.
double nice_step(double range) {
  const double raw = range / 3.0, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double times : {1.0, 2.0, 5.0}) {
    if (times * power >= raw) return times * power;
  }
  return 10.0 * power;
}

/// The part of the plane that the chart shows.
struct Scale {
  double low = 0.0, high = 0.0;  // 0 always belongs to it
  double from_s = 0.0, to_s = 0.0;

  explicit Scale(const FigureSeries& series) {
    const auto seconds = [](Time t) { return std::chrono::duration<double>(t.time_since_epoch()).count(); };
    from_s = seconds(series.points.front().at);
    to_s = std::max(seconds(series.points.back().at), from_s + 1.0);
    for (const SeriesPoint& point : series.points) {
      for (const double value : {point.value.value, point.value.low.value_or(0.0), point.value.high.value_or(0.0)}) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    if (high - low < 1e-9) high = low + 1.0;
  }
  double x(Time t) const {
    const double s = std::chrono::duration<double>(t.time_since_epoch()).count();
    return kLeft + (s - from_s) / (to_s - from_s) * (kWidth - kLeft - kRight);
  }
  double y(double value) const { return kTop + (high - value) / (high - low) * (kHeight - kTop - kBottom); }
};

std::string line(double x1, double y1, double x2, double y2, const char* role) {
  return "<line class=\"" + std::string(role) + "\" x1=\"" + place(x1) + "\" y1=\"" + place(y1) + "\" x2=\"" +
         place(x2) + "\" y2=\"" + place(y2) + "\"/>";
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + place(x) + "\" y=\"" + place(y) + "\" text-anchor=\"" + anchor + "\">" + escaped(text) +
         "</text>";
}

std::string day(Time at, const std::string& time_zone) { return local_text(at, time_zone).substr(0, 10); }

}  // namespace

std::string trend_chart(const FigureSeries& series, const std::string& time_zone) {
  if (series.points.empty()) return "";
  const Scale scale(series);
  std::string svg = "<svg class=\"trend\" viewBox=\"0 0 340 150\" role=\"img\" aria-label=\"" +
                    escaped(std::string(title_of(series.figure)) + ", " + series.zone) + "\">";
  const double step = nice_step(scale.high - scale.low);
  for (double tick = std::ceil(scale.low / step) * step; tick <= scale.high + 1e-9 * step; tick += step) {
    const bool zero = std::abs(tick) < 1e-9 * step;
    svg += line(kLeft, scale.y(tick), kWidth - kRight, scale.y(tick), zero ? "zero" : "grid");
    svg += label(kLeft - 6.0, scale.y(tick) + 3.5, "end",
                 number_text(tick, step >= 1.0 ? 0 : static_cast<int>(std::ceil(-std::log10(step)))));
  }
  std::string way;
  for (const SeriesPoint& point : series.points) {
    if (!std::isfinite(point.value.value)) continue;
    const double x = scale.x(point.at);
    way += (way.empty() ? "M" : "L") + place(x) + " " + place(scale.y(point.value.value));
    if (point.value.low && point.value.high && std::isfinite(*point.value.low) && std::isfinite(*point.value.high)) {
      svg += line(x, scale.y(*point.value.low), x, scale.y(*point.value.high), "bar");
    }
  }
  svg += "<path class=\"way\" d=\"" + way + "\"/>";
  for (const SeriesPoint& point : series.points) {
    if (!std::isfinite(point.value.value)) continue;
    svg += "<circle class=\"dot\" cx=\"" + place(scale.x(point.at)) + "\" cy=\"" + place(scale.y(point.value.value)) +
           "\" r=\"2.6\"/>";
  }
  svg += label(kLeft, kHeight - 8.0, "start", day(series.points.front().at, time_zone));
  if (series.points.size() > 1) {
    svg += label(kWidth - kRight, kHeight - 8.0, "end", day(series.points.back().at, time_zone));
  }
  return svg + "</svg>";
}

}  // namespace raywatch
