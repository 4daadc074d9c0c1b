#include "storage/survey_files/survey_csv.hpp"

#include <cmath>

#include "storage/formats/out_buffer.hpp"

namespace raywatch {
namespace {

/// One row of a table; ends itself.
class Row {
 public:
  explicit Row(OutBuffer& out) : out_(out) {}
  ~Row() { out_.character('\n'); }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  Row& number(double value) {
    separate();
    if (std::isfinite(value)) out_.number(value);
    return *this;
  }
  Row& count(std::size_t value) {
    separate();
    out_.number(value);
    return *this;
  }
  /// Quoted, as RFC 4180 has it.
  Row& text(std::string_view value) {
    separate();
    out_.character('"');
    for (const char c : value) {
      if (c == '"') out_.character('"');
      out_.character(c);
    }
    out_.character('"');
    return *this;
  }
  Row& vector(const Eigen::Vector3d& value) { return number(value.x()).number(value.y()).number(value.z()); }
  Row& figure(const VolumeFigure& value) {
    return number(value.value_m3).number(value.low_m3()).number(value.high_m3());
  }
  Row& mass(const std::optional<MassFigure>& value) {
    const double none = std::nan("");
    return number(value ? value->value_t : none)
        .number(value ? value->low_t : none)
        .number(value ? value->high_t : none);
  }

 private:
  void separate() {
    if (!first_) out_.character(',');
    first_ = false;
  }
  OutBuffer& out_;
  bool first_ = true;
};

std::string names_of(const SurveyResult& survey, const SurveyChange& change) {
  std::string names;
  for (const std::size_t zone : change.zones) {
    if (zone < survey.zones.size()) names += (names.empty() ? "" : "; ") + survey.zones[zone].zone.name;
  }
  return names;
}

void zone_row(OutBuffer& out, const ZoneFigures& figures) {
  const ZoneVolumes& v = figures.volumes;
  const auto mass = [&](auto member) {
    return figures.masses ? std::optional((*figures.masses).*member) : std::nullopt;
  };
  Row row(out);
  row.text(figures.zone.name).number(v.area_m2).number(v.seen_share()).number(v.changed_area_m2);
  row.figure(v.cut).figure(v.fill).figure(v.changed_net).figure(v.net);
  row.number(v.unseen.low_m3).number(v.unseen.high_m3).number(v.whole().low_m3).number(v.whole().high_m3);
  row.number(v.vertical.greatest_rise_m).number(v.vertical.greatest_fall_m).number(v.vertical.mean_m);
  row.number(figures.m3c2.greatest_m()).number(figures.m3c2.mean_m).number(figures.m3c2.mean_lod95_m);
  row.mass(mass(&ZoneMasses::cut)).mass(mass(&ZoneMasses::fill)).mass(mass(&ZoneMasses::net));
}

}  // namespace

void write_changes_csv(std::ostream& stream, const SurveyDocument& document) {
  OutBuffer out(stream);
  out.text(
      "change,kind,x_m,y_m,z_m,length_m,width_m,height_m,points,confidence,net_m3,net_low_m3,net_high_m3,area_m2,"
      "seen_area_m2,mass_t,mass_low_t,mass_high_t,zones\n");
  std::size_t number = 0;
  for (const SurveyChange& change : document.survey.changes) {
    const bool measured = change.volume.seen_area_m2 > 0.0;
    const VolumeFigure none{.value_m3 = std::nan("")};
    Row row(out);
    row.count(++number).text(to_string(change.change.kind));
    row.vector(document.frame.output_from_local(change.change.centroid_m)).vector(change.change.box.size_m);
    row.count(change.change.points).number(change.change.confidence.value);
    row.figure(measured ? change.volume.net : none).number(change.volume.area_m2).number(change.volume.seen_area_m2);
    row.mass(measured ? change.mass : std::nullopt).text(names_of(document.survey, change));
  }
  out.flush();
}

void write_zones_csv(std::ostream& stream, const SurveyDocument& document) {
  OutBuffer out(stream);
  out.text("zone,area_m2,seen_share,changed_area_m2");
  for (const char* figure : {"cut", "fill", "changed_net", "net"}) {
    for (const char* end : {"", "_low", "_high"}) out.text("," + std::string(figure) + end + "_m3");
  }
  out.text(
      ",unseen_low_m3,unseen_high_m3,whole_low_m3,whole_high_m3,greatest_rise_m,greatest_fall_m,mean_change_m,"
      "m3c2_greatest_m,m3c2_mean_m,m3c2_lod95_m");
  for (const char* figure : {"cut", "fill", "net"}) {
    for (const char* end : {"", "_low", "_high"}) out.text("," + std::string(figure) + end + "_t");
  }
  out.character('\n');
  for (const ZoneFigures& zone : document.survey.zones) zone_row(out, zone);
  zone_row(out, document.survey.total);
  out.flush();
}

}  // namespace raywatch
