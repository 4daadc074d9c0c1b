#pragma once

#include <string>

#include "storage/survey_files/survey_document.hpp"

namespace raywatch {

/// The changes and zones as a GeoJSON feature collection: the outlines of zones, and of the boxes of changes.
///
/// RFC 7946 knows WGS 84 only. With an EPSG code of the site, coordinates are longitude and latitude in degrees, by
/// PROJ, and each feature has the same outline in the site's coordinates as its foreign member `site_outline_m`.
/// Without one (or with a mine grid) there is no way to WGS 84: coordinates are those of the site or grid in metres,
/// and the foreign member `coordinate_system` of the collection says so.
/// @throws InvalidInput as `ToWgs84`.
std::string survey_geojson(const SurveyDocument& document);

}  // namespace raywatch
