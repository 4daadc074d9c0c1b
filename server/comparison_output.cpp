#include "server/comparison_output.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "storage/formats/write.hpp"

namespace raywatch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kDegree = std::numbers::pi / 180.0;

struct Planes {
  std::vector<float> x_m, y_m, z_m;

  explicit Planes(std::size_t size) : x_m(size), y_m(size), z_m(size) {}
  void set(std::size_t i, const Eigen::Vector3d& point_m) {
    x_m[i] = static_cast<float>(point_m.x());
    y_m[i] = static_cast<float>(point_m.y());
    z_m[i] = static_cast<float>(point_m.z());
  }
};

Planes world_points(const FileScan& scan) {
  Planes world(scan.points.size());
  const Eigen::Matrix3d rotation = scan.world_from_sensor.orientation.toRotationMatrix();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scan.points.size(), 1 << 16), [&](const auto& block) {
    for (std::size_t i = block.begin(); i < block.end(); ++i) {
      world.set(i, rotation * scan.points[i].cast<double>() + scan.world_from_sensor.position_m);
    }
  });
  return world;
}

PointFormat output_format(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".csv") return PointFormat::csv;
  if (ending == ".pcd") return PointFormat::pcd;
  if (ending == ".ply") return PointFormat::ply;
  throw InvalidInput(file.string() + ": the ending must be .csv, .pcd or .ply");
}

/// Whether both lead to the same file, by whatever names and links; also when it is not there yet.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code absent;
  return fs::equivalent(a, b, absent) || fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

void write_table(const fs::path& file, const PointTable& table) {
  std::ofstream out(file, std::ios::binary);
  if (!out) throw StorageError(file.string() + ": cannot be written");
  write_points(out, output_format(file), table);
  out.close();
  if (!out) throw StorageError(file.string() + ": cannot be written to the end");
}

std::array<std::string_view, kPointClasses> class_names() {
  std::array<std::string_view, kPointClasses> names;
  for (std::size_t i = 0; i < kPointClasses; ++i) names[i] = to_string(static_cast<PointClass>(i));
  return names;
}

Json to_array(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json to_array(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

Json change_json(std::size_t id, const Change& change, const Eigen::Vector3d& origin_m) {
  return {{"id", id},
          {"kind", to_string(change.kind)},
          {"centroid_m", to_array(change.centroid_m + origin_m)},
          {"size_m", to_array(change.box.size_m)},
          {"volume_m3", change.volume_m3},
          {"points", change.points},
          {"box",
           {{"center_m", to_array(change.box.center_m + origin_m)},
            {"orientation_xyzw", to_array(change.box.world_from_box)}}},
          {"confidence",
           {{"value", change.confidence.value},
            {"free", change.confidence.free},
            {"supported", change.confidence.supported},
            {"unknown", change.confidence.unknown}}}};
}

Json parameters_json(const CompareParameters& p) {
  return {{"grouping", to_string(p.grouping)},
          {"angle_deg", p.angle_rad ? Json(*p.angle_rad / kDegree) : Json(nullptr)},
          {"range_m", p.range_m},
          {"support_distance_m", p.support_distance_m},
          {"growth_distance_m", p.growth_distance_m},
          {"foliage_distance_m", p.foliage_distance_m},
          {"clustering", p.clustering},
          {"cluster_distance_m", p.cluster_distance_m},
          {"cluster_min_points", p.cluster_min_points},
          {"min_range_m", p.min_range_m},
          {"max_range_m", p.max_range_m},
          {"contemporary_s", std::chrono::duration<double>(p.contemporary_tolerance).count()},
          {"align", p.align}};
}

Json registration_json(const FileRegistration& registration, const Eigen::Vector3d& origin_m) {
  const Alignment& found = registration.alignment;
  const Pose correction = with_origin(found.correction, origin_m);
  return {{"state", to_string(found.state)},
          {"correction",
           {{"position_m", to_array(correction.position_m)}, {"orientation_xyzw", to_array(correction.orientation)}}},
          {"shift_m", registration.size.position_m},
          {"turn_deg", registration.size.angle_rad / kDegree},
          {"residual_m", found.state == RegistrationState::none ? Json(nullptr) : Json(found.residual_m)},
          {"inliers", found.inliers},
          {"uncertainty",
           {{"position_m", found.uncertainty.position_m}, {"angle_deg", found.uncertainty.angle_rad / kDegree}}}};
}

Json priors_json(const FileComparisonRequest& request, const FileComparison& comparison) {
  const Comparison& result = comparison.result;
  Json priors = Json::array();
  for (std::size_t i = 0; i < result.priors.size(); ++i) {
    const PriorShare& share = result.priors[i];
    const Json registration = comparison.registrations.empty()
                                  ? Json(nullptr)
                                  : registration_json(comparison.registrations[i], comparison.origin_m);
    priors.push_back({{"file", request.priors[i].string()},
                      {"added", share.added},
                      {"removed", share.removed},
                      {"angle_deg", share.angle_rad / kDegree},
                      {"registration", registration}});
  }
  return priors;
}

}  // namespace

void check_outputs(const FileComparisonRequest& request, const std::vector<fs::path>& outputs) {
  std::vector<fs::path> taken;
  for (const fs::path& output : outputs) {
    if (output.empty()) continue;
    output_format(output);
    const auto is_output = [&](const fs::path& file) { return is_same_file(file, output); };
    if (is_output(request.scan) || std::ranges::any_of(request.priors, is_output)) {
      throw InvalidInput(output.string() + ": is one of the scans; give another file to write to");
    }
    if (std::ranges::any_of(taken, is_output)) {
      throw InvalidInput(output.string() + ": is given twice; each output needs a file of its own");
    }
    taken.push_back(output);
  }
}

void write_classes(const fs::path& file, const FileComparison& comparison) {
  const Comparison& result = comparison.result;
  const Planes world = world_points(comparison.scan);
  const auto names = class_names();
  // An enumeration over std::uint8_t has the representation of it.
  const std::span<const std::uint8_t> classes(reinterpret_cast<const std::uint8_t*>(result.classes.data()),
                                              result.classes.size());
  write_table(file, {.x_m = world.x_m,
                     .y_m = world.y_m,
                     .z_m = world.z_m,
                     .columns = {{"class", classes, names},
                                 {"free", std::span(result.free), {}},
                                 {"supported", std::span(result.supported), {}},
                                 {"cluster", std::span(result.change_of), {}}},
                     .origin_m = comparison.origin_m,
                     .viewpoint = {}});
}

void write_removed(const fs::path& file, const FileComparison& comparison) {
  std::vector<PriorPoint> removed;
  std::ranges::copy_if(comparison.result.prior_points, std::back_inserter(removed),
                       [](const PriorPoint& point) { return point.point_class == PointClass::removed; });
  Planes world(removed.size());
  std::vector<std::int32_t> prior, index, cluster;
  for (std::size_t i = 0; i < removed.size(); ++i) {
    const PriorPoint& point = removed[i];
    const FileScan& scan = comparison.priors[point.prior];
    world.set(i, scan.world_from_sensor * scan.points[point.index].cast<double>());
    prior.push_back(static_cast<std::int32_t>(point.prior));
    index.push_back(static_cast<std::int32_t>(point.index));
    cluster.push_back(point.change);
  }
  write_table(file, {.x_m = world.x_m,
                     .y_m = world.y_m,
                     .z_m = world.z_m,
                     .columns = {{"prior", std::span<const std::int32_t>(prior), {}},
                                 {"index", std::span<const std::int32_t>(index), {}},
                                 {"cluster", std::span<const std::int32_t>(cluster), {}}},
                     .leading_columns = 2,
                     .origin_m = comparison.origin_m,
                     .viewpoint = {}});
}

std::string to_json(const FileComparisonRequest& request, const FileComparison& comparison, double write_ms,
                    double total_ms) {
  const Comparison& result = comparison.result;
  Json counts, changes = Json::array();
  for (std::size_t i = 0; i < kPointClasses; ++i) counts[to_string(static_cast<PointClass>(i))] = result.counts[i];
  for (std::size_t i = 0; i < result.changes.size(); ++i) {
    changes.push_back(change_json(i, result.changes[i], comparison.origin_m));
  }
  const Json json = {{"scan", request.scan.string()},
                     {"parameters", parameters_json(request.parameters)},
                     {"priors", priors_json(request, comparison)},
                     {"counts", counts},
                     {"testable", result.testable},
                     {"changes", changes},
                     {"warnings", result.warnings},
                     {"timings_ms",
                      {{"read", comparison.timings.read_ms},
                       {"index", comparison.timings.index_ms},
                       {"align", comparison.timings.align_ms},
                       {"detect", comparison.timings.detect_ms},
                       {"cluster", comparison.timings.cluster_ms},
                       {"write", write_ms},
                       {"total", total_ms}}}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace raywatch
