#include "storage/survey_files/survey_rasters.hpp"

namespace raywatch {
namespace {

GeoTiff raster_of(const SurveyDocument& document, const char* what) {
  GeoTiff raster{.layout = document.survey.before_model.layout, .frame = document.frame, .bands = {}};
  raster.metadata = {{"TIFFTAG_SOFTWARE", "raywatch " + document.survey.program_version},
                     {"TIFFTAG_IMAGEDESCRIPTION", what},
                     {"RAYWATCH_SITE", document.site},
                     {"RAYWATCH_SURVEY", std::to_string(document.id.value)},
                     {"RAYWATCH_BEFORE", format_rfc3339(document.before_at)},
                     {"RAYWATCH_AFTER", format_rfc3339(document.after_at)},
                     {"RAYWATCH_UNITS", "metres"},
                     {"RAYWATCH_COORDINATES", document.frame.grid   ? "local mine grid"
                                              : document.frame.epsg ? "EPSG:" + std::to_string(*document.frame.epsg)
                                                                    : std::string("site, local")}};
  return raster;
}

}  // namespace

GeoTiff elevation_raster(const SurveyDocument& document, SurveyEpochSide side) {
  const bool before = side == SurveyEpochSide::before;
  const ElevationModel& model = before ? document.survey.before_model : document.survey.after_model;
  GeoTiff raster = raster_of(document, before ? "Heights of the earlier epoch" : "Heights of the later epoch");
  raster.bands = {{"height", "m", {}}, {"standard error", "m", {}}};
  const double up_m = document.frame.output_from_local(Eigen::Vector3d::Zero()).z();
  for (const ElevationCell& cell : model.cells) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    raster.bands[0].values.push_back(static_cast<float>(cell.height_m + up_m));
    raster.bands[1].values.push_back(static_cast<float>(cell.seen() ? cell.sigma_m : none));
  }
  return raster;
}

GeoTiff difference_raster(const SurveyDocument& document) {
  GeoTiff raster = raster_of(document, "Rise of the ground from the earlier to the later epoch");
  raster.bands = {{"rise", "m", {}}, {"level of detection, 95 %", "m", {}}};
  for (const DifferenceCell& cell : document.survey.difference) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    raster.bands[0].values.push_back(static_cast<float>(cell.rise_m));
    raster.bands[1].values.push_back(static_cast<float>(cell.seen() ? cell.lod95_m : none));
  }
  return raster;
}

}  // namespace raywatch
