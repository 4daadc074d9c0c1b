#include "storage/survey_files/survey_report.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <numbers>
#include <regex>

#include "storage/survey_files/map_image.hpp"
#include "storage/survey_files/report_text.hpp"
#include "tests/survey_files/pit_survey.hpp"

namespace raywatch {
namespace {

/// Checks that every element is closed in the order in which it was opened, and every attribute is quoted.
/// Returns the number of elements.
int check_well_formed(const std::string& html) {
  const std::size_t begin = html.find("<html"), style = html.find("<style>"), style_end = html.find("</style>");
  const std::string text = html.substr(begin, style - begin) + html.substr(style_end + 8);
  static const std::regex element(R"re(<(/?)([a-zA-Z0-9]+)((?:\s+[a-zA-Z0-9:-]+="[^"<]*")*)\s*(/?)>)re");
  std::vector<std::string> open;
  int count = 0;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    std::smatch found;
    // The maps are long attributes: the end of the element is looked for first, so that the pattern need not.
    std::string part = text.substr(at, text.find('>', at) - at + 1);
    if (part.starts_with("<image")) part = std::regex_replace(part, std::regex("base64,[A-Za-z0-9+/=]{1,}"), "");
    REQUIRE_MESSAGE(std::regex_match(part, found, element), part.substr(0, 200));
    ++count;
    if (found[4] == "/") continue;
    if (found[1] == "/") {
      REQUIRE_FALSE(open.empty());
      CHECK(open.back() == found[2].str());
      open.pop_back();
    } else {
      open.push_back(found[2]);
    }
  }
  CHECK(open.empty());
  return count;
}

TEST_CASE("in a mine grid the report says which, and its arrow points to the grid's north; a mass of nothing is none") {
  const PitSurvey pit;
  SurveyResult quiet = pit.document().survey;
  REQUIRE(quiet.zones.front().masses);
  quiet.zones.front().masses = ZoneMasses{};
  const SurveyDocument document{
      .survey = quiet,
      .id = SurveyId{4},
      .site = "pit",
      .before_at = {},
      .after_at = {},
      .made_at = {},
      .frame = {.grid = MineGrid{.grid_origin_m = {5000.0, 9000.0, 0.0}, .rotation_rad = std::numbers::pi / 6.0}}};
  const std::string html = survey_report(document);
  CHECK(check_well_formed(html) > 300);
  CHECK(html.find("(5,000.000; 9,000.000; 0.000) is the place (0.000; 0.000; 0.000) of the site, turned by 30.000000°, "
                  "scale 1.00000000") != std::string::npos);
  CHECK(html.find("transform=\"rotate(30.000000 ") != std::string::npos);
  CHECK(html.find(">grid N<") != std::string::npos);
  CHECK(html.find("<td>none</td><td>none</td><td>none</td>") != std::string::npos);
}

TEST_CASE("a report is well-formed, self-contained, without scripts, and says what a surveyor needs") {
  const PitSurvey pit;
  const SurveyDocument document = pit.document({.origin_m = {400000.0, 5500000.0, 200.0}, .epsg = 25833});
  const std::string html = survey_report(document);
  // For looking at it.
  if (const char* const path = std::getenv("RAYWATCH_REPORT")) std::ofstream(path) << html;
  CHECK(check_well_formed(html) > 300);
  CHECK(html.find("<script") == std::string::npos);
  CHECK(html.find("http:") == std::string::npos);
  CHECK(html.find("https:") == std::string::npos);
  CHECK(html.find("url(") == std::string::npos);
  CHECK(html.find("@import") == std::string::npos);
  CHECK(html.find("href=\"data:image/png;base64,") != std::string::npos);
  std::size_t maps = 0;
  for (std::size_t at = html.find("href=\""); at != std::string::npos; at = html.find("href=\"", at + 1)) {
    CHECK(html.compare(at, 28, "href=\"data:image/png;base64,") == 0);
    ++maps;
  }
  CHECK(maps == 4);
  CHECK(html.find("src=\"") == std::string::npos);
  for (const char* part :
       {"Pit &amp; quarry", "bench &lt;south&gt;", "2026-03-28 23:30:00 CET", "@page { size: A4", "between ",
        "ETRS89 / UTM zone 33N (EPSG:25833)", "raywatch 0.1.0", "8.1\u00a0mm", "Station 2 saw 12 % less"}) {
    CHECK_MESSAGE(html.find(part) != std::string::npos, part);
  }
  for (const SurveyedScan& scan : pit.result.before) CHECK(html.find(scan.sha256) != std::string::npos);
}

TEST_CASE("a survey in which nothing was seen is still a report") {
  SurveyResult survey;
  survey.before_model.layout = survey.after_model.layout = {.cell_m = 1.0, .columns = 2, .rows = 2};
  survey.before_model.cells.resize(4);
  survey.after_model.cells.resize(4);
  survey.difference.resize(4);
  ZoneFigures zone{.zone = {.name = "all", .prism = {{{0, 0}, {2, 0}, {2, 2}}, 0, 1}}};
  zone.volumes.area_m2 = 2.0;
  survey.zones = {zone};
  survey.total = zone;
  const SurveyDocument document{
      .survey = survey, .id = {1}, .site = "x", .before_at = {}, .after_at = {}, .made_at = {}};
  const std::string html = survey_report(document);
  check_well_formed(html);
  CHECK(html.find("Nothing of the zones was seen in both epochs.") != std::string::npos);
  CHECK(html.find("This is the first survey of its series.") != std::string::npos);
  CHECK(html.find("nan") == std::string::npos);
}

TEST_CASE("numbers are written for people") {
  CHECK(number_text(1234567.891, 1) == "1,234,567.9");
  CHECK(number_text(-1234.5, 0) == "\u22121,234");
  CHECK(number_text(999.0, 0) == "999");
  CHECK(number_text(-0.001, 1) == "0.0");
  CHECK(number_text(std::nan(""), 1) == "-");
  CHECK(between_text(1240.2, 1310.4, "m³") == "between 1,240 and 1,310\u00a0m³");
  CHECK(between_text(-std::numeric_limits<double>::infinity(), 12.34, "m³") == "at most 12.3\u00a0m³");
  CHECK(escaped("<a href='x'>&\"") == "&lt;a href=&#39;x&#39;&gt;&amp;&quot;");
}

TEST_CASE("the ramp is fixed: each rise has its colour, and what did not surely change is grey") {
  ElevationModel model{.layout = {.cell_m = 1.0, .columns = 4, .rows = 1}};
  model.cells.assign(4, {.height_m = 0.0});
  std::vector<DifferenceCell> difference(4);
  difference[0] = {.rise_m = -7.0, .lod95_m = 0.1};
  difference[1] = {.rise_m = 0.3, .lod95_m = 0.1};
  difference[2] = {.rise_m = 0.3, .lod95_m = 0.5};
  const MapImage map = difference_map(model, model, difference);
  REQUIRE(map.pixels.size() == 4);
  CHECK(map.pixels[0] == difference_ramp().front().colour);
  CHECK(map.pixels[1] == difference_ramp()[7].colour);
  CHECK(map.pixels[2] == kUnchangedColour);
  CHECK(map.pixels[3][0] >= 200);  // not seen
}

}  // namespace
}  // namespace raywatch
