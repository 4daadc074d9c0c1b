#include "storage/survey_files/survey_geojson.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "storage/site_crs.hpp"

namespace raywatch {
namespace {

using OrderedJson = nlohmann::ordered_json;
using Outline = std::vector<Eigen::Vector2d>;

OrderedJson number(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr); }

OrderedJson figure_json(const VolumeFigure& figure) {
  return {{"value", number(figure.value_m3)}, {"low", number(figure.low_m3())}, {"high", number(figure.high_m3())}};
}

OrderedJson bounds_json(const VolumeBounds& bounds) {
  return {{"low", number(bounds.low_m3)}, {"high", number(bounds.high_m3)}};
}

/// Counter-clockwise, as RFC 7946 wants outer rings.
Outline counter_clockwise(Outline outline) {
  double twice_area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  if (twice_area < 0.0) std::reverse(outline.begin(), outline.end());
  return outline;
}

Outline outline_of(const OrientedBox& box) {
  Outline outline;
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    const Eigen::Vector3d corner = box.world_from_box * Eigen::Vector3d(x * box.size_m.x(), y * box.size_m.y(), 0.0);
    outline.push_back((box.center_m + corner).head<2>());
  }
  return outline;
}

class Collection {
 public:
  explicit Collection(const SurveyDocument& document) : document_(document) {
    if (document.frame.epsg && !document.frame.grid) to_wgs84_.emplace(*document.frame.epsg);
    json_ = {{"type", "FeatureCollection"},
             {"site", document.site},
             {"survey", document.id.value},
             {"before", format_rfc3339(document.before_at)},
             {"after", format_rfc3339(document.after_at)}};
    if (!to_wgs84_) {
      json_["coordinate_system"] = {{"name", document.frame.grid ? "local mine grid" : "coordinates of the site"},
                                    {"unit", "m"},
                                    {"wgs84", false}};
    }
    json_["features"] = OrderedJson::array();
  }

  void add(const Outline& local_m, OrderedJson properties) {
    OrderedJson ring = OrderedJson::array(), site_ring = OrderedJson::array();
    const Outline outline_m = counter_clockwise(local_m);
    for (std::size_t i = 0; i <= outline_m.size(); ++i) {
      const Eigen::Vector2d& corner_m = outline_m[i % outline_m.size()];
      const Eigen::Vector2d out_m = document_.frame.output_from_local({corner_m.x(), corner_m.y(), 0.0}).head<2>();
      site_ring.push_back({out_m.x(), out_m.y()});
      if (!to_wgs84_) continue;
      const Eigen::Vector2d degrees = to_wgs84_->longitude_latitude_deg(out_m);
      ring.push_back({degrees.x(), degrees.y()});
    }
    OrderedJson feature = {{"type", "Feature"},
                           {"geometry", {{"type", "Polygon"}, {"coordinates", {to_wgs84_ ? ring : site_ring}}}},
                           {"properties", std::move(properties)}};
    if (to_wgs84_) feature["site_outline_m"] = site_ring;
    json_["features"].push_back(std::move(feature));
  }

  std::string text() const { return json_.dump(1, ' ', false, OrderedJson::error_handler_t::replace); }

 private:
  const SurveyDocument& document_;
  std::optional<ToWgs84> to_wgs84_;
  OrderedJson json_;
};

OrderedJson zone_properties(const ZoneFigures& zone) {
  const ZoneVolumes& v = zone.volumes;
  return {{"type", "zone"},
          {"name", zone.zone.name},
          {"area_m2", number(v.area_m2)},
          {"seen_share", number(v.seen_share())},
          {"changed_area_m2", number(v.changed_area_m2)},
          {"cut_m3", figure_json(v.cut)},
          {"fill_m3", figure_json(v.fill)},
          {"changed_net_m3", figure_json(v.changed_net)},
          {"net_m3", figure_json(v.net)},
          {"whole_m3", bounds_json(v.whole())}};
}

OrderedJson change_properties(const SurveyChange& change, std::size_t number_of, double base_m) {
  OrderedJson properties = {{"type", "change"},
                            {"number", number_of},
                            {"kind", to_string(change.change.kind)},
                            {"points", change.change.points},
                            {"confidence", number(change.change.confidence.value)},
                            {"z_min_m", number(change.change.bounds_m.min().z() + base_m)},
                            {"z_max_m", number(change.change.bounds_m.max().z() + base_m)}};
  if (change.volume.seen_area_m2 > 0.0) properties["net_m3"] = figure_json(change.volume.net);
  return properties;
}

}  // namespace

std::string survey_geojson(const SurveyDocument& document) {
  Collection collection(document);
  for (const ZoneFigures& zone : document.survey.zones) {
    collection.add(zone.zone.prism.polygon_m, zone_properties(zone));
  }
  const double base_m = document.frame.output_from_local(Eigen::Vector3d::Zero()).z();
  std::size_t number_of = 0;
  for (const SurveyChange& change : document.survey.changes) {
    collection.add(outline_of(change.change.box), change_properties(change, ++number_of, base_m));
  }
  return collection.text();
}

}  // namespace raywatch
