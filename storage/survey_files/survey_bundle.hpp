#pragma once

#include <filesystem>

#include "storage/survey_files/survey_document.hpp"

namespace raywatch {

/// A file to put into a bundle beside what every bundle has.
struct BundledFile {
  std::string name;  ///< in the bundle, such as "after.las"
  std::filesystem::path path;
};

/// A ZIP file (64-bit where it must be) with report.html, changes.csv, zones.csv, survey.geojson, before.tif,
/// after.tif, difference.tif and the files given. Equal surveys give equal bytes: files have the time at which the
/// survey was made. Works in `work_dir`, which must exist and is left as it was. Loads GDAL, and with an EPSG code
/// PROJ.
/// @throws StorageError when something cannot be written.
void write_bundle(const SurveyDocument& document, std::span<const BundledFile> others,
                  const std::filesystem::path& work_dir, const std::filesystem::path& path);

}  // namespace raywatch
