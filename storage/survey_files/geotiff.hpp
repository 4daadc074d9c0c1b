#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/grid_layout.hpp"
#include "core/output_frame.hpp"

namespace raywatch {

struct GeoTiffBand {
  std::string description;
  std::string unit;           ///< "m"
  std::vector<float> values;  ///< one a cell of the layout, in its order; NaN: no data
};

/// A raster of the site.
struct GeoTiff {
  GridLayout layout;  ///< relative to the site's origin
  OutputFrame frame;
  std::vector<GeoTiffBand> bands;
  std::vector<std::pair<std::string, std::string>> metadata = {};
};

/// What stands for a cell that was not seen.
inline constexpr float kNoData = -9999.0f;

/// Writes it: tiles of 256 x 256, DEFLATE with the predictor for floating point, north up (in a turned mine grid with a
/// turned geotransform), a value standing for the area of its cell, the site's coordinate reference system when it has
/// one. Loads GDAL. @throws StorageError when it cannot be written, InvalidInput when a band has not one value a cell.
void write_geotiff(const GeoTiff& raster, const std::filesystem::path& path);

}  // namespace raywatch
