#include "storage/survey_files/report_tables.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "storage/local_time.hpp"
#include "storage/survey_files/report_text.hpp"

namespace raywatch {
namespace {

constexpr double kMillimetres = 1000.0, kDegrees = 57.29577951308232;

std::string row(std::initializer_list<std::string> cells, const char* cell = "td") {
  std::string html = "<tr>";
  for (const std::string& text : cells) html += "<" + std::string(cell) + ">" + text + "</" + cell + ">";
  return html + "</tr>";
}

std::string table(const char* kind, const std::string& head, const std::string& body) {
  return "<div class=\"wide\"><table class=\"" + std::string(kind) + "\"><thead>" + head + "</thead><tbody>" + body +
         "</tbody></table></div>";
}

/// The value, and below it its interval.
std::string with_interval(const std::string& value, const std::string& interval) {
  return value + "<small>" + interval + "</small>";
}

std::string volume_cell(const VolumeFigure& figure, bool with_sign) {
  if (figure.value_m3 == 0.0 && figure.sigma_m3() == 0.0) return "none";
  const double value = figure.value_m3;
  return with_interval((with_sign ? signed_text(value) : amount_text(value)) + "\u00a0m³", between_text(figure));
}

std::string zone_row(const ZoneFigures& zone) {
  const ZoneVolumes& v = zone.volumes;
  const VolumeBounds whole = v.whole();
  const std::string name = "<b>" + escaped(zone.zone.name) + "</b>";
  const std::string area = with_interval(amount_text(v.area_m2) + "\u00a0m²", percent_text(v.seen_share()) + " seen");
  if (v.seen_area_m2 == 0.0) {
    return row({name, area, "-", "-", "-", between_text(whole.low_m3, whole.high_m3, "m³"), "-"});
  }
  const std::string heights = with_interval("+" + number_text(v.vertical.greatest_rise_m, 2) + "\u00a0m, " +
                                                number_text(v.vertical.greatest_fall_m, 2) + "\u00a0m",
                                            "over " + amount_text(v.changed_area_m2) + "\u00a0m²");
  return row({name, area, volume_cell(v.cut, false), volume_cell(v.fill, false), volume_cell(v.net, true),
              between_text(whole.low_m3, whole.high_m3, "m³"), heights});
}

std::string mass_row(const ZoneFigures& zone) {
  const auto cell = [](const MassFigure& mass) -> std::string {
    if (mass.value_t == 0.0 && mass.low_t == 0.0 && mass.high_t == 0.0) return "none";
    return with_interval(amount_text(mass.value_t) + "\u00a0t", between_text(mass.low_t, mass.high_t, "t"));
  };
  return row({"<b>" + escaped(zone.zone.name) + "</b>", cell(zone.masses->cut), cell(zone.masses->fill),
              cell(zone.masses->net)});
}

std::string m3c2_row(const ZoneFigures& zone) {
  const M3c2Figures& m = zone.m3c2;
  const std::string name = "<b>" + escaped(zone.zone.name) + "</b>";
  if (m.measured == 0) return row({name, "0", "-", "-", "-"});
  return row({name, number_text(static_cast<double>(m.measured), 0), number_text(static_cast<double>(m.significant), 0),
              m.significant > 0 ? number_text(m.greatest_m(), 3) + "\u00a0m" : "-",
              number_text(m.mean_lod95_m, 3) + "\u00a0m"});
}

std::string place_text(const SurveyDocument& document, const Eigen::Vector3d& local_m) {
  const Eigen::Vector3d at_m = document.frame.output_from_local(local_m);
  return number_text(at_m.x(), 1) + "; " + number_text(at_m.y(), 1) + "; " + number_text(at_m.z(), 1);
}

std::string scan_rows(const SurveyDocument& document, const char* epoch, const std::vector<SurveyedScan>& scans) {
  std::string body;
  for (const SurveyedScan& scan : scans) {
    body += row({epoch, std::to_string(scan.scan.value), escaped(local_text(scan.captured_at, document.time_zone)),
                 number_text(static_cast<double>(scan.points), 0), "<code>" + escaped(scan.sha256) + "</code>"});
  }
  return body;
}

std::string registration_rows(const SurveyDocument& document, const char* epoch,
                              const std::vector<SurveyedScan>& scans) {
  std::string body;
  for (const SurveyedScan& scan : scans) {
    body += row({epoch, std::to_string(scan.scan.value), std::to_string(scan.station.value),
                 place_text(document, scan.world_from_sensor.position_m), std::string(to_string(scan.registration)),
                 scan.residual_m ? number_text(kMillimetres * *scan.residual_m, 1) + "\u00a0mm" : "-",
                 number_text(kMillimetres * scan.uncertainty.position_m, 1) + "\u00a0mm",
                 number_text(kDegrees * scan.uncertainty.angle_rad, 4) + "°"});
  }
  return body;
}

std::string grid_text(const MineGrid& grid) {
  const auto place = [](const Eigen::Vector3d& at_m) {
    return number_text(at_m.x(), 3) + "; " + number_text(at_m.y(), 3) + "; " + number_text(at_m.z(), 3);
  };
  return "local mine grid: (" + place(grid.grid_origin_m) + ") is the place (" + place(grid.site_origin_m) +
         ") of the site, turned by " + number_text(kDegrees * grid.rotation_rad, 6) + "°, scale " +
         number_text(grid.scale, 8);
}

std::string setting(const char* name, const std::string& value) { return row({name, value}); }

}  // namespace

std::string zones_table(const SurveyDocument& document) {
  const SurveyResult& survey = document.survey;
  const bool several = survey.zones.size() > 1;
  std::string body, masses, normal;
  for (const ZoneFigures& zone : survey.zones) {
    body += zone_row(zone);
    normal += m3c2_row(zone);
    if (zone.masses) masses += mass_row(zone);
  }
  if (several) {
    body += zone_row(survey.total);
    normal += m3c2_row(survey.total);
    if (survey.total.masses) masses += mass_row(survey.total);
  }
  std::string html = table(
      "figures",
      row({"Zone", "Area", "Cut", "Fill", "Net of the ground seen", "Net of the whole zone", "Greatest rise and fall"},
          "th"),
      body);
  if (!masses.empty()) {
    html += "<h3>Masses, at " + number_text(survey.definition.density_t_per_m3.value_or(0.0), 2) + " t/m³</h3>" +
            table("figures", row({"Zone", "Cut", "Fill", "Net of the ground seen"}, "th"), masses);
  }
  html += "<h3>Along the local normal (M3C2)</h3>" +
          table("figures",
                row({"Zone", "Places measured", "Significantly changed", "Greatest change", "Mean level of detection"},
                    "th"),
                normal);
  return html;
}

std::string changes_table(const SurveyDocument& document) {
  const std::vector<SurveyChange>& changes = document.survey.changes;
  if (changes.empty()) return "<p class=\"none\">Nothing was found that appeared or disappeared.</p>";
  std::vector<std::size_t> order(changes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::abs(changes[a].volume.net.value_m3) > std::abs(changes[b].volume.net.value_m3);
  });
  if (order.size() > kMostReportedChanges) order.resize(kMostReportedChanges);
  std::string body;
  for (const std::size_t i : order) {
    const SurveyChange& change = changes[i];
    const Eigen::Vector3d& size_m = change.change.box.size_m;
    body += row({std::to_string(i + 1), std::string(to_string(change.change.kind)),
                 place_text(document, change.change.centroid_m),
                 number_text(size_m.x(), 1) + " × " + number_text(size_m.y(), 1) + " × " + number_text(size_m.z(), 1),
                 change.volume.seen_area_m2 > 0.0 ? volume_cell(change.volume.net, true) : "not seen in both epochs",
                 percent_text(change.change.confidence.value)});
  }
  std::string html =
      table("figures", row({"No.", "Kind", "Place (x; y; z), m", "Size, m", "Volume, net", "Confidence"}, "th"), body);
  if (changes.size() > kMostReportedChanges) {
    html += "<p class=\"note\">The " + std::to_string(kMostReportedChanges) + " largest of " +
            std::to_string(changes.size()) + "; all are in changes.csv.</p>";
  }
  return html;
}

std::string registration_table(const SurveyDocument& document) {
  return table("figures",
               row({"Epoch", "Scan", "Station", "Position (x; y; z), m", "State", "Residual", "Position uncertain by",
                    "Direction uncertain by"},
                   "th"),
               registration_rows(document, "before", document.survey.before) +
                   registration_rows(document, "after", document.survey.after));
}

std::string basis_tables(const SurveyDocument& document) {
  const SurveyResult& survey = document.survey;
  std::string html = table("basis", row({"Epoch", "Scan", "Taken", "Points", "SHA-256 of the file"}, "th"),
                           scan_rows(document, "before", survey.before) + scan_rows(document, "after", survey.after));
  const OutputFrame& frame = document.frame;
  std::string body = setting("Program", "raywatch " + escaped(survey.program_version));
  body += setting("Cell of the elevation models", number_text(survey.definition.cell_m, 2) + "\u00a0m");
  if (const std::optional<double> steepest = survey.definition.greatest_slope_deg) {
    body += setting("Steepest ground, as stated", number_text(*steepest, 0) + "°");
  }
  body += setting("Grouping of the comparison", std::string(to_string(survey.parameters.grouping)));
  body += setting("Registration error in M3C2", number_text(kMillimetres * survey.registration_m, 1) + "\u00a0mm");
  body += setting("Points that the other epoch can judge",
                  percent_text(survey.testable_before) + " before, " + percent_text(survey.testable_after) + " after");
  body +=
      setting("Coordinates", frame.grid   ? grid_text(*frame.grid)
                             : frame.epsg ? escaped(document.crs_name) + " (EPSG:" + std::to_string(*frame.epsg) + ")"
                                          : "of the site, local");
  return html + table("basis", row({"Setting", "Value"}, "th"), body);
}

}  // namespace raywatch
