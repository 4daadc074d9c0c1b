#pragma once

#include <string>
#include <vector>

#include "core/output_frame.hpp"
#include "core/survey.hpp"
#include "core/survey_ids.hpp"
#include "core/trend.hpp"

namespace raywatch {

/// A value of a figure at one survey, with its interval where it has one.
struct SeriesPoint {
  Time at;
  FigureValue value;
};

/// One figure through time, as a report shows it.
struct FigureSeries {
  std::string zone;  ///< its name, or "total"
  SurveyFigure figure = SurveyFigure::net_m3;
  std::vector<SeriesPoint> points;  ///< in the order of time
};

/// A survey with what its files need to say besides: all functions of this folder take it. Places in the survey are
/// relative to the site's origin; they go out as `frame` says.
struct SurveyDocument {
  const SurveyResult& survey;  ///< with its models and changes; without points
  SurveyId id;
  std::string site;
  std::string time_zone = "UTC";  ///< of the site: IANA name
  Time before_at, after_at, made_at;
  OutputFrame frame = {};
  std::string crs_name = {};  ///< of the site's coordinates; empty: local ones
  std::vector<FigureSeries> series = {};
};

}  // namespace raywatch
