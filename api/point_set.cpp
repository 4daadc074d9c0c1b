#include "api/point_set.hpp"

#include <array>

#include "api/voxel_thinning.hpp"
#include "core/compare.hpp"

namespace raywatch {
namespace {

template <class T>
std::vector<T> picked(const std::vector<T>& values, std::span<const std::uint32_t> places) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(places.size());
  for (const std::uint32_t place : places) result.push_back(values[place]);
  return result;
}

/// What CSV prints for a class.
std::span<const std::string_view> class_names() {
  static const auto names = [] {
    std::array<std::string_view, kPointClasses> list;
    for (std::size_t i = 0; i < kPointClasses; ++i) list[i] = to_string(static_cast<PointClass>(i));
    return list;
  }();
  return names;
}

template <class T>
void add_column(PointTable& table, const char* name, const std::vector<T>& values) {
  if (!values.empty()) table.columns.push_back({name, std::span<const T>(values), {}});
}

PointTable table_of(const PointSet& set) {
  PointTable table{
      .x_m = set.x_m, .y_m = set.y_m, .z_m = set.z_m, .origin_m = set.origin_m, .viewpoint = set.viewpoint};
  add_column(table, "intensity", set.intensity);
  if (!set.point_class.empty()) {
    table.columns.push_back({"class", std::span<const std::uint8_t>(set.point_class), class_names()});
  }
  add_column(table, "free", set.free);
  add_column(table, "supported", set.supported);
  add_column(table, "change", set.change);
  add_column(table, "prior", set.prior);
  return table;
}

}  // namespace

PointRequest parse_point_request(Query& query, Frame usual_frame) {
  PointRequest request;
  const auto frame = query.parsed("frame", [](const std::string& text) { return parse_frame(text); });
  const auto format = query.parsed("format", [](const std::string& text) { return parse_point_format(text); });
  request.frame = frame.value_or(usual_frame);
  request.format = format.value_or(PointFormat::pcd);
  request.voxel_m = query.real("voxel_m", {.min = 0.001, .max = 1000.0});
  return request;
}

std::string text_of(const PointRequest& request) {
  return std::string(request.frame == Frame::world ? "world" : "sensor") + "," + std::string(ending(request.format)) +
         "," + (request.voxel_m ? to_text(*request.voxel_m) : "all");
}

Eigen::Vector3f moved(const Eigen::Vector3f& point_m, const Pose& to_from_points) {
  if (!point_m.allFinite()) return point_m;
  return (to_from_points * point_m.cast<double>()).cast<float>();
}

void append_moved(PointSet& set, const PointCloud& points, const Pose& to_from_points) {
  for (std::size_t i = 0; i < points.size(); ++i) set.push_back(moved(points[i], to_from_points));
}

PointSet thinned(const PointSet& set, double voxel_m) {
  const auto places = thin({set.x_m, set.y_m, set.z_m, set.point_class}, voxel_m);
  return {.x_m = picked(set.x_m, places),
          .y_m = picked(set.y_m, places),
          .z_m = picked(set.z_m, places),
          .intensity = picked(set.intensity, places),
          .point_class = picked(set.point_class, places),
          .free = picked(set.free, places),
          .supported = picked(set.supported, places),
          .change = picked(set.change, places),
          .prior = picked(set.prior, places),
          .origin_m = set.origin_m,
          .viewpoint = set.viewpoint};
}

std::string_view ending(PointFormat format) {
  switch (format) {
    case PointFormat::pcd:
      return "pcd";
    case PointFormat::ply:
      return "ply";
    case PointFormat::csv:
      return "csv";
    case PointFormat::bin:
      break;
  }
  return "bin";
}

void suggest_file_name(HttpAnswer& answer, const std::string& file_name) {
  answer.set_header("Content-Disposition", "attachment; filename=\"" + file_name + "\"");
}

HttpAnswer point_answer(std::shared_ptr<const PointSet> set, PointFormat format, const std::string& name) {
  HttpAnswer answer;
  answer.content_type = media_type(format);
  answer.stream = [points = std::move(set), format](std::ostream& out) {
    write_points(out, format, table_of(*points));
  };
  suggest_file_name(answer, name + "." + std::string(ending(format)));
  return answer;
}

}  // namespace raywatch
