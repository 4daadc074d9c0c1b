#include "api/point_set.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "api/ordered_points.hpp"
#include "api/refinement.hpp"
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

/// The points at these places, in their order.
PointSet at(const PointSet& set, std::span<const std::uint32_t> places) {
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
          .viewpoint = set.viewpoint,
          .quantisation = set.quantisation};
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
  PointTable table{.x_m = set.x_m,
                   .y_m = set.y_m,
                   .z_m = set.z_m,
                   .origin_m = set.origin_m,
                   .viewpoint = set.viewpoint,
                   .quantisation = set.quantisation};
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

void parse_budget(Query& query, PointRequest& request) {
  constexpr std::int64_t kMost = 10'000'000;
  constexpr std::size_t kUsual = 1'000'000;
  const auto budget = query.integer("budget", {.min = 1, .max = kMost});
  const auto skip = query.integer("skip", {.min = 0, .max = std::numeric_limits<std::uint32_t>::max()});
  if (budget) request.budget = static_cast<std::size_t>(*budget);
  if (request.format == PointFormat::q16 && !budget) request.budget = kUsual;
  if (skip) request.skip = static_cast<std::size_t>(*skip);
  if (skip && !request.budget) query.fail("skip", "goes with budget, or with format=q16: else nothing says the order");
}

}  // namespace

PointRequest parse_point_request(Query& query, Frame usual_frame) {
  PointRequest request;
  const auto frame = query.parsed("frame", [](const std::string& text) { return parse_frame(text); });
  const auto format = query.parsed("format", [](const std::string& text) { return parse_point_format(text); });
  request.frame = frame.value_or(usual_frame);
  request.format = format.value_or(PointFormat::pcd);
  request.voxel_m = query.real("voxel_m", {.min = 0.001, .max = 1000.0});
  parse_budget(query, request);
  return request;
}

std::string text_of(const PointRequest& request) {
  return std::string(request.frame == Frame::world ? "world" : "sensor") + "," + std::string(ending(request.format)) +
         "," + (request.voxel_m ? to_text(*request.voxel_m) : "all") + "," +
         (request.budget ? std::to_string(*request.budget) : "all") + "," + std::to_string(request.skip);
}

Eigen::Vector3f moved(const Eigen::Vector3f& point_m, const Pose& to_from_points) {
  if (!point_m.allFinite()) return point_m;
  return (to_from_points * point_m.cast<double>()).cast<float>();
}

void append_moved(PointSet& set, const PointCloud& points, const Pose& to_from_points) {
  for (std::size_t i = 0; i < points.size(); ++i) set.push_back(moved(points[i], to_from_points));
}

PointRequest whole(const PointRequest& request) { return {.frame = request.frame, .voxel_m = request.voxel_m}; }

std::size_t bytes_of(const PointSet& set) {
  const std::size_t floats = set.x_m.size() + set.y_m.size() + set.z_m.size() + set.intensity.size();
  const std::size_t numbers = set.change.size() + set.prior.size();
  return sizeof(set) + 4 * (floats + numbers) + set.point_class.size() + set.free.size() + set.supported.size();
}

PointSet thinned(PointSet set, const PointRequest& request) {
  if (request.voxel_m) set = at(set, thin({set.x_m, set.y_m, set.z_m, set.point_class}, *request.voxel_m));
  return set;
}

PointSet refined(const PointSet& set) {
  const CoordinatePlanes points{set.x_m, set.y_m, set.z_m};
  PointSet result = at(set, refinement_order(points));
  result.quantisation = quantisation_of(points, set.intensity);
  return result;
}

PointSet part_of(const PointSet& refined, const PointRequest& request) {
  const std::size_t first = std::min(request.skip, refined.size());
  std::vector<std::uint32_t> places(std::min(request.budget.value_or(refined.size()), refined.size() - first));
  std::iota(places.begin(), places.end(), static_cast<std::uint32_t>(first));
  PointSet part = at(refined, places);
  if (part.quantisation) part.quantisation->first = first;
  return part;
}

std::shared_ptr<const PointSet> requested_points(OrderedPoints& kept, const std::string& key,
                                                 const PointRequest& request, const std::function<PointSet()>& gather) {
  if (!request.budget) return std::make_shared<const PointSet>(thinned(gather(), request));
  const auto all = kept.get(key, [&] { return refined(thinned(gather(), request)); });
  return std::make_shared<const PointSet>(part_of(*all, request));
}

std::string_view ending(PointFormat format) {
  switch (format) {
    case PointFormat::pcd:
      return "pcd";
    case PointFormat::ply:
      return "ply";
    case PointFormat::csv:
      return "csv";
    case PointFormat::q16:
      return "q16";
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
