#include "storage/survey_files/geotiff.hpp"

#include <cpl_conv.h>
#include <doctest/doctest.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {
namespace {

/// Three columns and two rows of 2 m; the value of a cell is its number, cell 4 has none.
GeoTiff small_raster() {
  GeoTiff raster{.layout = {.origin_m = {10.0, 20.0}, .cell_m = 2.0, .columns = 3, .rows = 2},
                 .frame = {.origin_m = {500000.0, 5540000.0, 100.0}, .epsg = 25833}};
  raster.bands = {{"rise", "m", {0.0f, 1.0f, 2.0f, 3.0f, std::nanf(""), 5.0f}}};
  raster.metadata = {{"RAYWATCH_SURVEY", "12"}};
  return raster;
}

/// The file as GDAL, linked into this test, reads it.
struct Opened {
  GDALDatasetH dataset;
  std::array<double, 6> transform{};

  explicit Opened(const std::filesystem::path& path) {
    GDALAllRegister();
    dataset = GDALOpen(path.c_str(), GA_ReadOnly);
    REQUIRE(dataset != nullptr);
    REQUIRE(GDALGetGeoTransform(dataset, transform.data()) == CE_None);
  }
  ~Opened() { GDALClose(dataset); }
  std::string item(const char* key, const char* domain = nullptr) const {
    const char* const value = GDALGetMetadataItem(dataset, key, domain);
    return value == nullptr ? "" : value;
  }
  float value(int column, int row) const {
    float result = 0.0f;
    REQUIRE(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Read, column, row, 1, 1, &result, 1, 1, GDT_Float32, 0, 0) ==
            CE_None);
    return result;
  }
};

TEST_CASE("a raster reads back through GDAL: values, place, coordinates, no data, compression, what it is of") {
  const TempDir dir;
  const std::filesystem::path path = dir.path() / "small.tif";
  write_geotiff(small_raster(), path);
  const Opened file(path);
  CHECK(GDALGetRasterXSize(file.dataset) == 3);
  CHECK(GDALGetRasterYSize(file.dataset) == 2);
  CHECK(file.transform == std::array<double, 6>{500010.0, 2.0, 0.0, 5540024.0, 0.0, -2.0});
  CHECK(file.value(0, 0) == 3.0f);  // the north-west cell
  CHECK(file.value(2, 1) == 2.0f);  // the south-east one
  CHECK(file.value(1, 0) == kNoData);
  const GDALRasterBandH band = GDALGetRasterBand(file.dataset, 1);
  CHECK(GDALGetRasterDataType(band) == GDT_Float32);
  CHECK(GDALGetRasterNoDataValue(band, nullptr) == static_cast<double>(kNoData));
  CHECK(std::string(GDALGetRasterUnitType(band)) == "m");
  CHECK(std::string(GDALGetDescription(band)) == "rise");
  CHECK(file.item("AREA_OR_POINT") == "Area");
  CHECK(file.item("RAYWATCH_SURVEY") == "12");
  CHECK(file.item("COMPRESSION", "IMAGE_STRUCTURE") == "DEFLATE");
  CHECK(file.item("PREDICTOR", "IMAGE_STRUCTURE") == "3");
  int width = 0, height = 0;
  GDALGetBlockSize(band, &width, &height);
  CHECK(width == 256);
  CHECK(height == 256);
  const OGRSpatialReferenceH reference = GDALGetSpatialRef(file.dataset);
  REQUIRE(reference != nullptr);
  CHECK(std::string(OSRGetAuthorityCode(reference, nullptr)) == "25833");
}

TEST_CASE("in a turned mine grid the raster is turned, and has no coordinate reference system") {
  const TempDir dir;
  GeoTiff raster = small_raster();
  raster.frame.grid = MineGrid{.site_origin_m = {500010.0, 5540024.0, 0.0},
                               .grid_origin_m = {100.0, 200.0, 0.0},
                               .rotation_rad = std::numbers::pi / 2.0};
  write_geotiff(raster, dir.path() / "turned.tif");
  const Opened file(dir.path() / "turned.tif");
  // The north-west corner is the grid's origin; columns run to the grid's north, rows to its east.
  const std::array<double, 6> expected{100.0, 0.0, 2.0, 200.0, 2.0, 0.0};
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(file.transform[i] - expected[i]) < 1e-6);
  CHECK(GDALGetSpatialRef(file.dataset) == nullptr);
}

TEST_CASE("what cannot be written is refused with the reason") {
  CHECK_THROWS_AS(write_geotiff(small_raster(), "/nowhere/at/all.tif"), StorageError);
  GeoTiff raster = small_raster();
  raster.bands[0].values.pop_back();
  CHECK_THROWS_AS(write_geotiff(raster, "/tmp/unused.tif"), InvalidInput);
}

}  // namespace
}  // namespace raywatch
