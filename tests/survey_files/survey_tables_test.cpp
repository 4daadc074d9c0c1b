// The tables of a survey: CSV and GeoJSON.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "storage/survey_files/survey_csv.hpp"
#include "storage/survey_files/survey_geojson.hpp"
#include "tests/survey_files/pit_survey.hpp"

namespace raywatch {
namespace {

const PitSurvey& pit() {
  static const PitSurvey survey;
  return survey;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

std::size_t columns(const std::string& line) {
  std::size_t count = 1;
  bool quoted = false;
  for (const char c : line) {
    quoted ^= c == '"';
    count += c == ',' && !quoted ? 1 : 0;
  }
  return count;
}

TEST_CASE("every change and zone has a row with a value for every column") {
  std::ostringstream changes, zones;
  write_changes_csv(changes, pit().document());
  write_zones_csv(zones, pit().document());
  const std::vector<std::string> change_lines = lines(changes.str()), zone_lines = lines(zones.str());
  CHECK(pit().result.changes.size() > 0);
  CHECK(change_lines.size() == 1 + pit().result.changes.size());
  CHECK(zone_lines.size() == 1 + 2 + 1);
  for (const std::string& line : change_lines) CHECK(columns(line) == columns(change_lines[0]));
  for (const std::string& line : zone_lines) CHECK(columns(line) == columns(zone_lines[0]));
  CHECK(zone_lines[2].starts_with("\"bench, north\","));
  CHECK(zone_lines[3].starts_with("\"total\","));
}

TEST_CASE("with an EPSG code GeoJSON is in WGS 84, and has the site's coordinates beside") {
  const OutputFrame frame{.origin_m = {400000.0, 5500000.0, 200.0}, .epsg = 25833};
  const nlohmann::json json = nlohmann::json::parse(survey_geojson(pit().document(frame)));
  CHECK_FALSE(json.contains("coordinate_system"));
  REQUIRE(json["features"].size() == 2 + pit().result.changes.size());
  for (const auto& feature : json["features"]) {
    const auto& ring = feature["geometry"]["coordinates"][0];
    CHECK(ring.front() == ring.back());
    CHECK(ring.size() == feature["site_outline_m"].size());
    for (const auto& place : ring) {
      CHECK(place[0].get<double>() == doctest::Approx(13.61).epsilon(0.01));
      CHECK(place[1].get<double>() == doctest::Approx(49.64).epsilon(0.01));
    }
  }
  const auto& zone = json["features"][0];
  CHECK(zone["properties"]["name"] == "bench <south>");
  CHECK(zone["site_outline_m"][0] == nlohmann::json({399970.0, 5499920.0}));
  CHECK(zone["properties"]["net_m3"]["low"].get<double>() < zone["properties"]["net_m3"]["high"].get<double>());
}

TEST_CASE("without an EPSG code GeoJSON says that its coordinates are not WGS 84") {
  const nlohmann::json json = nlohmann::json::parse(survey_geojson(pit().document({.origin_m = {10.0, 20.0, 0.0}})));
  CHECK(json["coordinate_system"]["wgs84"] == false);
  CHECK(json["coordinate_system"]["unit"] == "m");
  CHECK(json["features"][0]["geometry"]["coordinates"][0][0] == nlohmann::json({-20.0, -60.0}));
  CHECK_FALSE(json["features"][0].contains("site_outline_m"));
}

}  // namespace
}  // namespace raywatch
