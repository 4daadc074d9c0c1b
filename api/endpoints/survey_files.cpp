#include <sstream>

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/survey_endpoints.hpp"
#include "api/lookup.hpp"
#include "api/point_set.hpp"
#include "api/render.hpp"
#include "api/render_survey.hpp"
#include "api/scratch_dir.hpp"
#include "storage/payloads.hpp"
#include "storage/site_crs.hpp"
#include "storage/survey_files/epoch_las.hpp"
#include "storage/survey_files/geotiff.hpp"
#include "storage/survey_files/survey_bundle.hpp"
#include "storage/survey_files/survey_csv.hpp"
#include "storage/survey_files/survey_geojson.hpp"
#include "storage/survey_files/survey_rasters.hpp"
#include "storage/survey_files/survey_report.hpp"
#include "storage/survey_series.hpp"

namespace raywatch::endpoints {
namespace {

/// A survey as it is stored, with all that its files say.
struct StoredSurvey {
  SurveyRecord record;
  SurveyResult result;
  Site site;
  std::vector<FigureSeries> series;

  SurveyDocument document() const {
    return {.survey = result,
            .id = record.id,
            .site = site.name,
            .time_zone = site.time_zone,
            .before_at = record.before_at,
            .after_at = record.after_at,
            .made_at = record.made_at,
            .frame = output_frame(site),
            .crs_name = site.epsg ? describe_crs(*site.epsg).name : "",
            .series = series};
  }
  std::string file_name(const std::string& ending) const {
    return "survey-" + std::to_string(record.id.value) + "-" + ending;
  }
};

/// The net of each zone, and in total, up to this survey: what a report draws through time.
std::vector<FigureSeries> series_of(const Snapshot& snapshot, const SurveyRecord& record, const SurveyResult& result) {
  constexpr std::size_t kMostValues = 366;
  std::vector<FigureSeries> all;
  const auto add = [&](const std::string& name, std::optional<ZoneId> zone) {
    const SeriesKey key{.site = record.site, .schedule = record.schedule, .zone = zone};
    FigureSeries series{.zone = name, .figure = key.figure, .points = {}};
    const Time until = record.after_at + std::chrono::nanoseconds(1);
    for (const SeriesValue& value : survey_series(snapshot, key, Time::min(), until, kMostValues)) {
      series.points.push_back({value.at, value.figure});
    }
    if (series.points.size() > 1) all.push_back(std::move(series));
  };
  if (!record.schedule) return all;
  for (const ZoneFigures& figures : result.zones) {
    if (figures.zone.zone) add(figures.zone.name, figures.zone.zone);
  }
  add("total", std::nullopt);
  return all;
}

StoredSurvey read_survey(Call& call) {
  call.query.finish();
  const auto id = id_in_path<SurveyId>(call.path[0]);
  StoredSurvey survey = call.services.store.read([&](const Snapshot& snapshot) {
    StoredSurvey found{.record = survey_with(snapshot, id), .result = survey_result(snapshot, id), .site = {}};
    found.result.changes = survey_changes(snapshot, id);
    found.site = site_with(snapshot, found.record.site);
    found.series = series_of(snapshot, found.record, found.result);
    return found;
  });
  read_models(call.services.store.payloads(), survey.record.models, survey.result);
  return survey;
}

HttpAnswer file_answer(Call& call, std::string content, const std::string& media_type, const std::string& name) {
  HttpAnswer answer;
  answer.content_type = media_type;
  answer.body = std::move(content);
  suggest_file_name(answer, name);
  return with_body_tag(std::move(answer), call.header("If-None-Match"));
}

constexpr const char* kTiff = "image/tiff";

HttpAnswer raster_answer(Call& call, const GeoTiff& raster, const std::string& name) {
  const ScratchDir scratch(call.config.spool_dir);
  const std::filesystem::path path = scratch / "raster.tif";
  write_geotiff(raster, path);
  return file_answer(call, content_of(path), kTiff, name);
}

template <class Write>
HttpAnswer csv_answer(Call& call, const std::string& ending, Write write) {
  const StoredSurvey survey = read_survey(call);
  std::ostringstream text;
  write(text, survey.document());
  return file_answer(call, text.str(), "text/csv; charset=utf-8", survey.file_name(ending));
}

/// The points of the later or the earlier epoch, with what the survey says of each.
void write_epoch_las(Call& call, const StoredSurvey& survey, SurveyEpochSide side, std::ostream& out) {
  const bool after = side == SurveyEpochSide::after;
  const std::vector<SurveyedScan>& scans = after ? survey.result.after : survey.result.before;
  const std::vector<ScanRecord> records = call.services.store.read([&](const Snapshot& snapshot) {
    std::vector<ScanRecord> found;
    for (const SurveyedScan& scan : scans) found.push_back(scan_with(snapshot, scan.scan));
    return found;
  });
  const PriorIndex unused = PriorIndex::build({}, {});  // views have one; nothing is asked here
  std::vector<PointCloud> clouds;
  for (const ScanRecord& record : records) clouds.push_back(call.services.store.payloads().scan_points(record.payload));
  EpochScans epoch;
  for (std::size_t k = 0; k < clouds.size(); ++k) {
    epoch.add({clouds[k], unused, scans[k].world_from_sensor, scans[k].captured_at, {}, {}}, 0);
  }
  const SurveyDocument document = survey.document();
  write_las(out, {.scans = epoch,
                  .about = after ? survey.result.after_points : survey.result.before_points,
                  .frame = document.frame,
                  .wkt = document.frame.epsg ? describe_crs(*document.frame.epsg).wkt : "",
                  .program_version = survey.result.program_version});
}

HttpAnswer las_answer(Call& call, SurveyEpochSide side, const std::string& ending) {
  const StoredSurvey survey = read_survey(call);
  std::ostringstream out;
  write_epoch_las(call, survey, side, out);
  return file_answer(call, std::move(out).str(), "application/vnd.las", survey.file_name(ending));
}

}  // namespace

HttpAnswer get_survey_difference_tiff(Call& call) {
  const StoredSurvey survey = read_survey(call);
  return raster_answer(call, difference_raster(survey.document()), survey.file_name("difference.tif"));
}

HttpAnswer get_survey_before_tiff(Call& call) {
  const StoredSurvey survey = read_survey(call);
  return raster_answer(call, elevation_raster(survey.document(), SurveyEpochSide::before),
                       survey.file_name("before.tif"));
}

HttpAnswer get_survey_after_tiff(Call& call) {
  const StoredSurvey survey = read_survey(call);
  return raster_answer(call, elevation_raster(survey.document(), SurveyEpochSide::after),
                       survey.file_name("after.tif"));
}

HttpAnswer get_survey_before_las(Call& call) { return las_answer(call, SurveyEpochSide::before, "before.las"); }
HttpAnswer get_survey_after_las(Call& call) { return las_answer(call, SurveyEpochSide::after, "after.las"); }

HttpAnswer get_survey_geojson(Call& call) {
  const StoredSurvey survey = read_survey(call);
  return file_answer(call, survey_geojson(survey.document()), "application/geo+json", survey.file_name("map.geojson"));
}

HttpAnswer get_survey_changes_csv(Call& call) { return csv_answer(call, "changes.csv", write_changes_csv); }
HttpAnswer get_survey_zones_csv(Call& call) { return csv_answer(call, "zones.csv", write_zones_csv); }

HttpAnswer get_survey_report(Call& call) {
  const StoredSurvey survey = read_survey(call);
  HttpAnswer answer;
  answer.content_type = "text/html; charset=utf-8";
  answer.body = survey_report(survey.document());
  // It has its style sheet and maps inside, and no script.
  answer.set_header("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'; img-src data:");
  return with_body_tag(std::move(answer), call.header("If-None-Match"));
}

HttpAnswer get_survey_bundle(Call& call) {
  const StoredSurvey survey = read_survey(call);
  const ScratchDir scratch(call.config.spool_dir);
  const std::filesystem::path path = scratch / "bundle.zip";
  write_bundle(survey.document(), {}, scratch.path(), path);
  return file_answer(call, content_of(path), "application/zip", survey.file_name("bundle.zip"));
}

}  // namespace raywatch::endpoints
