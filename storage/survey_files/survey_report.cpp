#include "storage/survey_files/survey_report.hpp"

#include "storage/local_time.hpp"
#include "storage/survey_files/report_maps.hpp"
#include "storage/survey_files/report_style.hpp"
#include "storage/survey_files/report_tables.hpp"
#include "storage/survey_files/report_text.hpp"
#include "storage/survey_files/trend_chart.hpp"

namespace raywatch {
namespace {

std::string section(const std::string& title, const std::string& body) {
  return "<section><h2>" + title + "</h2>" + body + "</section>";
}

std::string heading(const SurveyDocument& document) {
  const auto when = [&](Time at) { return escaped(local_text(at, document.time_zone)); };
  return "<header><h1>Survey " + std::to_string(document.id.value) + ", " + escaped(document.site) +
         "</h1><p class=\"sub\">Before: " + when(document.before_at) + " · After: " + when(document.after_at) +
         " · Times in " + escaped(document.time_zone) + "</p></header>";
}

std::string lead(const SurveyDocument& document) {
  const ZoneVolumes& v = document.survey.total.volumes;
  if (v.seen_area_m2 == 0.0) return "<p class=\"lead\">Nothing of the zones was seen in both epochs.</p>";
  const VolumeBounds whole = v.whole();
  return "<p class=\"lead\">Of the ground that both epochs saw (" + percent_text(v.seen_share()) + " of " +
         amount_text(v.area_m2) + "\u00a0m²), the net change is " + between_text(v.net) + ". Over " +
         amount_text(v.changed_area_m2) + "\u00a0m² it surely changed: " + between_text(v.cut) + " were cut and " +
         between_text(v.fill) + " were filled. With the ground that was not seen, the net is " +
         between_text(whole.low_m3, whole.high_m3, "m³") + ".</p>";
}

std::string tile(const std::string& value, const std::string& title, const std::string& below) {
  return "<div class=\"tile\"><span>" + title + "</span><b>" + value + "</b><span>" + below + "</span></div>";
}

std::string tiles(const SurveyDocument& document) {
  const ZoneVolumes& v = document.survey.total.volumes;
  const auto volume = [](const VolumeFigure& figure, bool with_sign, const char* title) {
    const double value = figure.value_m3;
    return tile((with_sign ? signed_text(value) : amount_text(value)) + "\u00a0m³", title, between_text(figure));
  };
  return "<div class=\"tiles\">" + volume(v.cut, false, "Cut") + volume(v.fill, false, "Fill") +
         volume(v.net, true, "Net of the ground seen") +
         tile(percent_text(v.seen_share()), "Seen in both epochs",
              amount_text(v.seen_area_m2) + " of " + amount_text(v.area_m2) + "\u00a0m²") +
         "</div>";
}

std::string warnings(const SurveyDocument& document) {
  if (document.survey.warnings.empty()) return "";
  std::string list;
  for (const std::string& warning : document.survey.warnings) list += "<li>" + escaped(warning) + "</li>";
  return "<div class=\"warnings\"><b>To be kept in mind</b><ul>" + list + "</ul></div>";
}

std::string trends(const SurveyDocument& document) {
  std::string charts;
  for (const FigureSeries& series : document.series) {
    if (series.points.empty()) continue;
    const std::string_view unit = unit_text(unit_of(series.figure));
    charts += "<figure><figcaption>" + escaped(title_of(series.figure)) + ", " + escaped(series.zone) +
              (unit.empty() ? "" : " (" + std::string(unit) + ")") + "</figcaption>" +
              trend_chart(series, document.time_zone) + "</figure>";
  }
  if (charts.empty()) return "<p class=\"none\">This is the first survey of its series.</p>";
  return "<div class=\"trends\">" + charts + "</div>";
}

constexpr std::string_view kHowToRead =
    "<p>Where an interval is given, the true figure lies in it in 95 of 100 surveys. <b>Cut</b> and <b>fill</b> are of "
    "the ground that surely changed and the cells beside it, and rest on the rest of the ground not having changed. "
    "The <b>net of the ground seen</b> is of all cells that both epochs saw, changed or not; an error of a station's "
    "pose counts over all of them, so that its interval is wider.</p>"
    "<p>The <b>net of the whole zone</b> interpolates nothing: where an epoch did not see the ground, it lies below "
    "what its rays passed over and above the lower end of the zone. These are bounds, not an interval: the true figure "
    "lies between them as surely as the ground that was seen is known.</p>"
    "<p>The <b>level of detection</b> is the change that errors alone exceed in 5 of 100 places.</p>";

}  // namespace

std::string survey_report(const SurveyDocument& document) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/><title>Survey " +
                     std::to_string(document.id.value) + ", " + escaped(document.site) +
                     "</title><meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/><style>" +
                     std::string(kReportStyle) + "</style></head><body>";
  html += heading(document) + lead(document) + warnings(document) + tiles(document);
  html += section("Maps", report_maps(document));
  html += section("Volumes by zone", zones_table(document));
  html += section("What appeared and disappeared", changes_table(document));
  html += section("Through time", trends(document));
  html += section("Registration", registration_table(document));
  html += section("How to read the figures", std::string(kHowToRead));
  html += section("What the figures rest on", basis_tables(document));
  return html + "<footer>Made by raywatch " + escaped(document.survey.program_version) + " on " +
         escaped(local_text(document.made_at, document.time_zone)) + ".</footer></body></html>\n";
}

}  // namespace raywatch
