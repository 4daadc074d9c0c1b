#include "storage/survey_files/survey_bundle.hpp"

#include <doctest/doctest.h>
#include <minizip/unzip.h>

#include <fstream>
#include <iterator>
#include <map>

#include "core/error.hpp"
#include "tests/support/temp_dir.hpp"
#include "tests/survey_files/pit_survey.hpp"

namespace raywatch {
namespace {

std::map<std::string, std::string> unzipped(const std::filesystem::path& path) {
  std::map<std::string, std::string> files;
  const unzFile zip = unzOpen64(path.c_str());
  REQUIRE(zip != nullptr);
  for (int found = unzGoToFirstFile(zip); found == UNZ_OK; found = unzGoToNextFile(zip)) {
    char name[256];
    unz_file_info64 info;
    REQUIRE(unzGetCurrentFileInfo64(zip, &info, name, sizeof name, nullptr, 0, nullptr, 0) == UNZ_OK);
    std::string content(info.uncompressed_size, '\0');
    REQUIRE(unzOpenCurrentFile(zip) == UNZ_OK);
    REQUIRE(unzReadCurrentFile(zip, content.data(), static_cast<unsigned>(content.size())) ==
            static_cast<int>(content.size()));
    REQUIRE(unzCloseCurrentFile(zip) == UNZ_OK);  // checks the CRC
    files[name] = content;
  }
  unzClose(zip);
  return files;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_CASE("a bundle has every file, reads back, is the same bytes each time, and leaves nothing behind") {
  const PitSurvey pit;
  const TempDir dir, work;
  std::ofstream(dir / "points.las", std::ios::binary) << "LASF and more";
  const std::vector<BundledFile> others{{"after.las", dir / "points.las"}};
  write_bundle(pit.document(), others, work.path(), dir / "bundle.zip");
  const auto files = unzipped(dir / "bundle.zip");
  CHECK(files.size() == 8);
  CHECK(files.at("after.las") == "LASF and more");
  CHECK(files.at("report.html").starts_with("<!DOCTYPE html>"));
  CHECK(files.at("changes.csv").starts_with("change,kind,"));
  CHECK(files.at("zones.csv").starts_with("zone,area_m2,"));
  CHECK(files.at("survey.geojson").find("FeatureCollection") != std::string::npos);
  for (const char* raster : {"before.tif", "after.tif", "difference.tif"}) {
    CHECK(files.at(raster).starts_with(std::string("II*\0", 4)));
  }
  CHECK(std::filesystem::is_empty(work.path()));
  write_bundle(pit.document(), others, work.path(), dir / "again.zip");
  CHECK(bytes_of(dir / "bundle.zip") == bytes_of(dir / "again.zip"));
}

TEST_CASE("what cannot be bundled leaves no half of a bundle") {
  const PitSurvey pit;
  const TempDir dir, work;
  const std::vector<BundledFile> others{{"after.las", dir / "missing.las"}};
  CHECK_THROWS_AS(write_bundle(pit.document(), others, work.path(), dir / "bundle.zip"), StorageError);
  CHECK_FALSE(std::filesystem::exists(dir / "bundle.zip"));
  CHECK_THROWS_AS(write_bundle(pit.document(), {}, work.path(), "/nowhere/bundle.zip"), StorageError);
}

}  // namespace
}  // namespace raywatch
