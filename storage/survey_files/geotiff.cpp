#include "storage/survey_files/geotiff.hpp"

#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "storage/shared_library.hpp"

namespace raywatch {
namespace {

/// The functions of GDAL that are used, with the types of its headers.
struct Gdal {
  decltype(&GDALRegister_GTiff) register_gtiff;
  decltype(&GDALGetDriverByName) driver_by_name;
  decltype(&GDALCreate) create;
  decltype(&GDALClose) close;
  decltype(&GDALSetGeoTransform) set_geo_transform;
  decltype(&GDALSetSpatialRef) set_spatial_ref;
  decltype(&GDALGetRasterBand) band;
  decltype(&GDALSetRasterNoDataValue) set_no_data;
  decltype(&GDALSetRasterUnitType) set_unit;
  decltype(&GDALSetDescription) set_description;
  decltype(&GDALSetMetadataItem) set_metadata_item;
  decltype(&GDALRasterIO) raster_io;
  decltype(&OSRNewSpatialReference) new_spatial_ref;
  decltype(&OSRImportFromEPSG) import_epsg;
  decltype(&OSRDestroySpatialReference) destroy_spatial_ref;
  decltype(&CPLPushErrorHandler) push_error_handler;
  decltype(&CPLPopErrorHandler) pop_error_handler;
  decltype(&CPLQuietErrorHandler) quiet;
  decltype(&CPLGetLastErrorMsg) last_error;

  Gdal() {
    const SharedLibrary library({.soname = "libgdal.so.32", .package = "libgdal32"});
    library.find(register_gtiff, "GDALRegister_GTiff");
    library.find(driver_by_name, "GDALGetDriverByName");
    library.find(create, "GDALCreate");
    library.find(close, "GDALClose");
    library.find(set_geo_transform, "GDALSetGeoTransform");
    library.find(set_spatial_ref, "GDALSetSpatialRef");
    library.find(band, "GDALGetRasterBand");
    library.find(set_no_data, "GDALSetRasterNoDataValue");
    library.find(set_unit, "GDALSetRasterUnitType");
    library.find(set_description, "GDALSetDescription");
    library.find(set_metadata_item, "GDALSetMetadataItem");
    library.find(raster_io, "GDALRasterIO");
    library.find(new_spatial_ref, "OSRNewSpatialReference");
    library.find(import_epsg, "OSRImportFromEPSG");
    library.find(destroy_spatial_ref, "OSRDestroySpatialReference");
    library.find(push_error_handler, "CPLPushErrorHandler");
    library.find(pop_error_handler, "CPLPopErrorHandler");
    library.find(quiet, "CPLQuietErrorHandler");
    library.find(last_error, "CPLGetLastErrorMsg");
    register_gtiff();
  }
};

const Gdal& gdal() {
  static const Gdal functions;
  return functions;
}

/// What is wrong is said by exceptions, not on the standard error of the daemon.
struct Quietly {
  Quietly() { gdal().push_error_handler(gdal().quiet); }
  ~Quietly() { gdal().pop_error_handler(); }
  Quietly(const Quietly&) = delete;
  Quietly& operator=(const Quietly&) = delete;
};

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw StorageError("Cannot write " + path.string() + ": " + gdal().last_error());
}

void check(CPLErr error, const std::filesystem::path& path) {
  if (error != CE_None) fail(path);
}

/// From the column and the row, counted from the north-west corner, to coordinates.
std::array<double, 6> geo_transform(const GridLayout& layout, const OutputFrame& frame) {
  const CellTransform cells = cell_transform(layout, frame);
  const Eigen::Vector2d corner_m = cells.corner_m + layout.rows * cells.a_row_m;
  return {corner_m.x(), cells.a_column_m.x(), -cells.a_row_m.x(),
          corner_m.y(), cells.a_column_m.y(), -cells.a_row_m.y()};
}

/// An open dataset; closing it writes what is left.
class Dataset {
 public:
  Dataset(const GeoTiff& raster, const std::filesystem::path& path) : path_(path) {
    // NOLINTNEXTLINE: GDAL's own type of a list of options.
    const std::array<const char*, 7> options{"TILED=YES",      "COMPRESS=DEFLATE", "PREDICTOR=3", "BLOCKXSIZE=256",
                                             "BLOCKYSIZE=256", "BIGTIFF=IF_SAFER", nullptr};
    handle_ = gdal().create(gdal().driver_by_name("GTiff"), path.c_str(), static_cast<int>(raster.layout.columns),
                            static_cast<int>(raster.layout.rows), static_cast<int>(raster.bands.size()), GDT_Float32,
                            const_cast<char**>(options.data()));
    if (handle_ == nullptr) fail(path);
  }
  ~Dataset() {
    if (handle_ != nullptr) gdal().close(handle_);
  }
  Dataset(const Dataset&) = delete;
  Dataset& operator=(const Dataset&) = delete;

  void describe(const GeoTiff& raster) {
    std::array<double, 6> transform = geo_transform(raster.layout, raster.frame);
    check(gdal().set_geo_transform(handle_, transform.data()), path_);
    check(gdal().set_metadata_item(handle_, "AREA_OR_POINT", "Area", nullptr), path_);
    for (const auto& [key, value] : raster.metadata) {
      check(gdal().set_metadata_item(handle_, key.c_str(), value.c_str(), nullptr), path_);
    }
    if (!raster.frame.epsg || raster.frame.grid) return;
    const OGRSpatialReferenceH reference = gdal().new_spatial_ref(nullptr);
    const bool known = gdal().import_epsg(reference, *raster.frame.epsg) == OGRERR_NONE;
    const bool set = known && gdal().set_spatial_ref(handle_, reference) == CE_None;
    gdal().destroy_spatial_ref(reference);
    if (!set) fail(path_);
  }

  void write(const GridLayout& layout, const GeoTiffBand& values, int number) {
    const GDALRasterBandH band = gdal().band(handle_, number);
    check(gdal().set_no_data(band, static_cast<double>(kNoData)), path_);
    check(gdal().set_unit(band, values.unit.c_str()), path_);
    gdal().set_description(band, values.description.c_str());
    const std::size_t columns = layout.columns, rows = layout.rows;
    std::vector<float> north_up(values.values.size());
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const float value = values.values[(rows - 1 - row) * columns + column];
        north_up[row * columns + column] = std::isfinite(value) ? value : kNoData;
      }
    }
    const int width = static_cast<int>(columns), height = static_cast<int>(rows);
    check(gdal().raster_io(band, GF_Write, 0, 0, width, height, north_up.data(), width, height, GDT_Float32, 0, 0),
          path_);
  }

 private:
  const std::filesystem::path& path_;
  GDALDatasetH handle_ = nullptr;
};

}  // namespace

void write_geotiff(const GeoTiff& raster, const std::filesystem::path& path) {
  for (const GeoTiffBand& band : raster.bands) {
    if (band.values.size() != raster.layout.cell_count()) {
      throw InvalidInput("The band " + band.description + " has not one value for each cell of its grid.");
    }
  }
  const Quietly quietly;
  Dataset dataset(raster, path);
  dataset.describe(raster);
  int number = 0;
  for (const GeoTiffBand& band : raster.bands) dataset.write(raster.layout, band, ++number);
}

}  // namespace raywatch
