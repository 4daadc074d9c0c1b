#include "storage/columns.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "storage/json_values.hpp"
#include "storage/sqlite.hpp"

namespace raywatch {
namespace {

static_assert(std::endian::native == std::endian::little, "the store's byte layouts are written as they lie in memory");

using json_values::dump;
using json_values::Json;
using json_values::parse;

double finite(double value, const char* name) {
  if (!std::isfinite(value)) throw InvalidInput("a number is not finite", {{name, "must be finite"}});
  return value;
}

void put(Json& json, const char* name, const std::optional<double>& value) {
  if (value) json[name] = finite(*value, name);
}

std::optional<double> get(const Json& json, const char* name) {
  const auto member = json.find(name);
  if (member == json.end()) return std::nullopt;
  return member->get<double>();
}

struct ReferenceWriter {
  Json operator()(const PreviousReference&) const { return "previous"; }
  Json operator()(const BaselineReference&) const { return "baseline"; }
  Json operator()(const WindowReference& window) const {
    return {{"from", window.from.time_since_epoch().count()}, {"to", window.to.time_since_epoch().count()}};
  }
  Json operator()(const ExplicitReference& reference) const {
    Json scans = Json::array();
    for (const ScanId scan : reference.scans) scans.push_back(scan.value);
    return {{"scans", scans}};
  }
};

Reference read_reference(const Json& json) {
  if (json == "baseline") return BaselineReference{};
  if (json.is_string()) return PreviousReference{};
  if (!json.contains("scans")) {
    return WindowReference{Time(Duration(json.at("from").get<std::int64_t>())),
                           Time(Duration(json.at("to").get<std::int64_t>()))};
  }
  ExplicitReference reference;
  for (const Json& scan : json.at("scans")) reference.scans.push_back(ScanId{scan.get<std::int64_t>()});
  return reference;
}

CompareParameters read_parameters(const Json& json) {
  return {.grouping = enum_from_text(json.at("grouping").get<std::string>(), {Grouping::union_, Grouping::consensus}),
          .angle_rad = get(json, "angle_rad"),
          .range_m = json.at("range_m").get<double>(),
          // Comparisons that were stored before there were such distances did not ask for them.
          .support_distance_m = get(json, "support_distance_m").value_or(0.0),
          .growth_distance_m = get(json, "growth_distance_m").value_or(0.0),
          .foliage_distance_m = get(json, "foliage_distance_m").value_or(0.0),
          .clustering = json.at("clustering").get<bool>(),
          .cluster_distance_m = json.at("cluster_distance_m").get<double>(),
          .cluster_min_points = json.at("cluster_min_points").get<std::size_t>(),
          .min_range_m = json.at("min_range_m").get<double>(),
          .max_range_m = json.at("max_range_m").get<double>(),
          .contemporary_tolerance = Duration(json.at("contemporary_tolerance_ns").get<std::int64_t>()),
          // Comparisons that were stored before there was a registration took the poses as reported.
          .align = json.value("align", false)};
}

}  // namespace

PoseBytes pose_bytes(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  const std::array<double, 7> numbers{
      pose.position_m.x(), pose.position_m.y(), pose.position_m.z(), q.x(), q.y(), q.z(), q.w()};
  return std::bit_cast<PoseBytes>(numbers);
}

Pose pose_from_bytes(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != sizeof(PoseBytes)) throw CorruptData("a stored pose has a wrong length");
  std::array<double, 7> n{};
  std::memcpy(n.data(), bytes.data(), bytes.size());
  return {Eigen::Quaterniond(n[6], n[3], n[4], n[5]), Eigen::Vector3d(n[0], n[1], n[2])};
}

Eigen::Vector3d take_vector(Statement& row) {
  const auto x = row.take<double>();
  const auto y = row.take<double>();
  const auto z = row.take<double>();
  return {x, y, z};
}

std::string model_json(const SensorModel& model) {
  Json json = Json::object();
  put(json, "range_noise_m", model.range_noise_m);
  if (model.angular_resolution_rad) {
    json["angular_resolution_rad"] = {finite(model.angular_resolution_rad->x(), "angular_resolution"),
                                      finite(model.angular_resolution_rad->y(), "angular_resolution")};
  }
  put(json, "beam_divergence_rad", model.beam_divergence_rad);
  put(json, "min_range_m", model.min_range_m);
  put(json, "max_range_m", model.max_range_m);
  put(json, "no_return_m", model.no_return_m);
  return dump(json);
}

SensorModel model_from_json(const std::string& text) {
  return parse(text, [](const Json& json) {
    SensorModel model{.range_noise_m = get(json, "range_noise_m"),
                      .angular_resolution_rad = std::nullopt,
                      .beam_divergence_rad = get(json, "beam_divergence_rad"),
                      .min_range_m = get(json, "min_range_m"),
                      .max_range_m = get(json, "max_range_m"),
                      .no_return_m = get(json, "no_return_m")};
    if (const auto angles = json.find("angular_resolution_rad"); angles != json.end()) {
      model.angular_resolution_rad = Eigen::Vector2d(angles->at(0).get<double>(), angles->at(1).get<double>());
    }
    return model;
  });
}

std::string reference_json(const Reference& reference) { return dump(std::visit(ReferenceWriter{}, reference)); }

Reference reference_from_json(const std::string& text) { return parse(text, read_reference); }

std::string parameters_json(const CompareParameters& parameters) {
  Json json = {{"grouping", to_string(parameters.grouping)},
               {"range_m", finite(parameters.range_m, "range_m")},
               {"support_distance_m", finite(parameters.support_distance_m, "support_distance_m")},
               {"growth_distance_m", finite(parameters.growth_distance_m, "growth_distance_m")},
               {"foliage_distance_m", finite(parameters.foliage_distance_m, "foliage_distance_m")},
               {"clustering", parameters.clustering},
               {"cluster_distance_m", finite(parameters.cluster_distance_m, "cluster_distance_m")},
               {"cluster_min_points", parameters.cluster_min_points},
               {"min_range_m", finite(parameters.min_range_m, "min_range_m")},
               {"max_range_m", finite(parameters.max_range_m, "max_range_m")},
               {"contemporary_tolerance_ns", parameters.contemporary_tolerance.count()},
               {"align", parameters.align}};
  put(json, "angle_rad", parameters.angle_rad);
  return dump(json);
}

CompareParameters parameters_from_json(const std::string& text) { return parse(text, read_parameters); }

std::string counts_json(const std::array<std::uint64_t, kPointClasses>& counts) { return dump(Json(counts)); }

std::array<std::uint64_t, kPointClasses> counts_from_json(const std::string& text) {
  return parse(text, [](const Json& json) {
    std::array<std::uint64_t, kPointClasses> counts{};
    if (!json.empty()) counts = json.get<std::array<std::uint64_t, kPointClasses>>();
    return counts;
  });
}

std::string timings_json(const std::map<std::string, double>& timings_ms) {
  for (const auto& [name, value] : timings_ms) finite(value, "timings_ms");
  return dump(Json(timings_ms));
}

std::map<std::string, double> timings_from_json(const std::string& text) {
  return parse(text, [](const Json& json) { return json.get<std::map<std::string, double>>(); });
}

BoxColumns box_columns(const std::optional<Eigen::AlignedBox3d>& box) {
  BoxColumns columns;
  if (!box) return columns;
  for (int axis = 0; axis < 3; ++axis) {
    columns.at(static_cast<std::size_t>(axis)) = box->min()[axis];
    columns.at(static_cast<std::size_t>(axis) + 3) = box->max()[axis];
  }
  return columns;
}

Eigen::AlignedBox3d take_box(Statement& row) {
  const Eigen::Vector3d low = take_vector(row);
  return {low, take_vector(row)};
}

std::optional<Eigen::AlignedBox3d> take_optional_box(Statement& row) {
  BoxColumns columns;
  for (std::optional<double>& column : columns) column = row.take<std::optional<double>>();
  const bool complete =
      std::all_of(columns.begin(), columns.end(), [](const auto& column) { return column.has_value(); });
  if (!complete) return std::nullopt;
  return Eigen::AlignedBox3d(Eigen::Vector3d(*columns[0], *columns[1], *columns[2]),
                             Eigen::Vector3d(*columns[3], *columns[4], *columns[5]));
}

std::string polygon_json(const std::vector<Eigen::Vector2d>& polygon) {
  Json json = Json::array();
  for (const Eigen::Vector2d& p : polygon) json.push_back({finite(p.x(), "polygon_m"), finite(p.y(), "polygon_m")});
  return dump(json);
}

std::vector<Eigen::Vector2d> polygon_from_json(const std::string& text) {
  return parse(text, [](const Json& json) {
    std::vector<Eigen::Vector2d> polygon;
    for (const Json& p : json) polygon.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
    return polygon;
  });
}

std::string rule_json(const Rule& rule) {
  Json schedule = Json::array();
  for (const ScheduleWindow& window : rule.schedule) {
    schedule.push_back({{"days", window.days}, {"from", window.from_minute}, {"to", window.to_minute}});
  }
  return dump({{"added", rule.added},
               {"removed", rule.removed},
               {"min_points", rule.min_points},
               {"min_volume_m3", finite(rule.min_volume_m3, "min_volume_m3")},
               {"min_extent_m", finite(rule.min_extent_m, "min_extent_m")},
               {"scans", rule.persistence.scans},
               {"of", rule.persistence.of},
               {"seconds", finite(rule.persistence.seconds, "persistence.seconds")},
               {"severity", to_string(rule.severity)},
               {"schedule", schedule},
               {"enabled", rule.enabled},
               {"auto_resolve", rule.auto_resolve}});
}

Rule rule_from_json(const std::string& text) {
  return parse(text, [](const Json& json) {
    Rule rule;
    rule.added = json.value("added", rule.added);
    rule.removed = json.value("removed", rule.removed);
    rule.min_points = json.value("min_points", rule.min_points);
    rule.min_volume_m3 = json.value("min_volume_m3", rule.min_volume_m3);
    rule.min_extent_m = json.value("min_extent_m", rule.min_extent_m);
    rule.persistence = {json.value("scans", 1u), json.value("of", 1u), json.value("seconds", 0.0)};
    rule.severity = parse_severity(json.value("severity", std::string(to_string(rule.severity))));
    for (const Json& window : json.value("schedule", Json::array())) {
      rule.schedule.push_back({window.at("days").get<std::array<bool, 7>>(), window.at("from").get<std::uint16_t>(),
                               window.at("to").get<std::uint16_t>()});
    }
    rule.enabled = json.value("enabled", rule.enabled);
    rule.auto_resolve = json.value("auto_resolve", rule.auto_resolve);
    return rule;
  });
}

std::string texts_json(const std::vector<std::string>& texts) { return dump(Json(texts)); }

std::vector<std::string> texts_from_json(const std::string& text) {
  return parse(text, [](const Json& json) { return json.get<std::vector<std::string>>(); });
}

}  // namespace raywatch
