#include "storage/survey_files/survey_bundle.hpp"

#include <minizip/zip.h>

#include <array>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "storage/survey_files/survey_csv.hpp"
#include "storage/survey_files/survey_geojson.hpp"
#include "storage/survey_files/survey_rasters.hpp"
#include "storage/survey_files/survey_report.hpp"

namespace raywatch {
namespace {

/// A ZIP file that is being written; without `finish` it is deleted.
class ZipFile {
 public:
  ZipFile(const std::filesystem::path& path, Time made_at)
      : path_(path), made_at_(made_at), zip_(zipOpen64(path.c_str(), APPEND_STATUS_CREATE)) {
    if (zip_ == nullptr) throw StorageError("Cannot write " + path.string() + ".");
  }
  ~ZipFile() {
    if (zip_ == nullptr) return;
    zipClose(zip_, nullptr);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ZipFile(const ZipFile&) = delete;
  ZipFile& operator=(const ZipFile&) = delete;

  void add(const std::string& name, const std::string& content) {
    begin(name);
    write(content);
    end();
  }
  void add(const BundledFile& file) {
    std::ifstream in(file.path, std::ios::binary);
    if (!in) throw StorageError("Cannot read " + file.path.string() + ".");
    begin(file.name);
    std::vector<char> block(std::size_t{1} << 20);
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
      write({block.data(), static_cast<std::size_t>(in.gcount())});
    }
    end();
  }
  void finish() {
    const int result = zipClose(std::exchange(zip_, nullptr), "raywatch");
    check(result);
  }

 private:
  void begin(const std::string& name) {
    const auto day = std::chrono::floor<std::chrono::days>(made_at_);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(std::chrono::floor<std::chrono::seconds>(made_at_ - day));
    zip_fileinfo info{};
    info.tmz_date.tm_year = static_cast<unsigned>(std::max(1980, static_cast<int>(date.year())));
    info.tmz_date.tm_mon = static_cast<unsigned>(date.month()) - 1;
    info.tmz_date.tm_mday = static_cast<unsigned>(date.day());
    info.tmz_date.tm_hour = static_cast<unsigned>(clock.hours().count());
    info.tmz_date.tm_min = static_cast<unsigned>(clock.minutes().count());
    info.tmz_date.tm_sec = static_cast<unsigned>(clock.seconds().count());
    constexpr int kZip64 = 1;
    check(zipOpenNewFileInZip64(zip_, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                                Z_DEFAULT_COMPRESSION, kZip64));
  }
  void write(std::string_view bytes) {
    check(zipWriteInFileInZip(zip_, bytes.data(), static_cast<unsigned>(bytes.size())));
  }
  void end() { check(zipCloseFileInZip(zip_)); }
  void check(int result) const {
    if (result != ZIP_OK) throw StorageError("Cannot write " + path_.string() + ": " + std::to_string(result) + ".");
  }

  const std::filesystem::path& path_;
  Time made_at_;
  zipFile zip_;
};

template <class Write>
std::string text_of(Write write, const SurveyDocument& document) {
  std::ostringstream out;
  write(out, document);
  return std::move(out).str();
}

void add_raster(ZipFile& zip, const char* name, const GeoTiff& raster, const std::filesystem::path& work_dir) {
  const std::filesystem::path path = work_dir / name;
  write_geotiff(raster, path);
  zip.add(BundledFile{name, path});
  std::filesystem::remove(path);
}

}  // namespace

void write_bundle(const SurveyDocument& document, std::span<const BundledFile> others,
                  const std::filesystem::path& work_dir, const std::filesystem::path& path) {
  ZipFile zip(path, document.made_at);
  zip.add("report.html", survey_report(document));
  zip.add("changes.csv", text_of(write_changes_csv, document));
  zip.add("zones.csv", text_of(write_zones_csv, document));
  zip.add("survey.geojson", survey_geojson(document));
  add_raster(zip, "before.tif", elevation_raster(document, SurveyEpochSide::before), work_dir);
  add_raster(zip, "after.tif", elevation_raster(document, SurveyEpochSide::after), work_dir);
  add_raster(zip, "difference.tif", difference_raster(document), work_dir);
  for (const BundledFile& file : others) zip.add(file);
  zip.finish();
}

}  // namespace raywatch
