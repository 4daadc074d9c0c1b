#pragma once

#include "storage/survey_files/geotiff.hpp"
#include "storage/survey_files/survey_document.hpp"

namespace raywatch {

enum class SurveyEpochSide : std::uint8_t { before, after };

/// The elevation model of an epoch: heights in the output's coordinates and their standard errors without the poses, m.
GeoTiff elevation_raster(const SurveyDocument& document, SurveyEpochSide side);

/// The later model minus the earlier one, and the level of detection with the poses, m.
GeoTiff difference_raster(const SurveyDocument& document);

}  // namespace raywatch
