#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/answer.hpp"
#include "api/query.hpp"
#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "storage/formats/scan_file.hpp"
#include "storage/formats/write.hpp"

namespace raywatch {

/// How points are asked for: `frame`, `format`, `voxel_m`, `budget`, `skip`.
struct PointRequest {
  Frame frame = Frame::sensor;
  PointFormat format = PointFormat::pcd;
  std::optional<double> voxel_m;
  std::optional<std::size_t> budget;  ///< at most so many points, in the order of refinement
  std::size_t skip = 0;               ///< of that order: how many the client has already
};
PointRequest parse_point_request(Query& query, Frame usual_frame);

/// The part of an entity tag that says how the points were asked for.
std::string text_of(const PointRequest& request);

/// The request for all of the set that this one asks a part of.
PointRequest whole(const PointRequest& request);

/// Points on their way out. Columns that are empty are not written.
struct PointSet {
  std::vector<float> x_m, y_m, z_m;
  std::vector<float> intensity;
  std::vector<std::uint8_t> point_class, free, supported;
  std::vector<std::int32_t> change, prior;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< what the coordinates are relative to
  Pose viewpoint;                                      ///< of PCD files
  std::optional<Quantisation> quantisation;            ///< of the set that this is a part of

  std::size_t size() const { return x_m.size(); }
  void push_back(const Eigen::Vector3f& point_m) {
    x_m.push_back(point_m.x());
    y_m.push_back(point_m.y());
    z_m.push_back(point_m.z());
  }
};

/// The points after `to_from_points`, computed in double. A point that is not finite stays as it is.
void append_moved(PointSet& set, const PointCloud& points, const Pose& to_from_points);
Eigen::Vector3f moved(const Eigen::Vector3f& point_m, const Pose& to_from_points);

std::size_t bytes_of(const PointSet& set);

/// As few points of the set as the request's voxels want: one a voxel and class (see `thin`).
PointSet thinned(PointSet set, const PointRequest& request);
/// The finite points of a set in the order of refinement (see `refinement_order`), with their quantisation.
PointSet refined(const PointSet& set);
/// The part of a refined set that the request's budget wants.
PointSet part_of(const PointSet& refined, const PointRequest& request);

class OrderedPoints;
/// The points that a request wants of all that `gather` gives. @param key names that set, for `kept`.
std::shared_ptr<const PointSet> requested_points(OrderedPoints& kept, const std::string& key,
                                                 const PointRequest& request, const std::function<PointSet()>& gather);

/// Streams the points; `name` is the suggested file name without its ending.
HttpAnswer point_answer(std::shared_ptr<const PointSet> set, PointFormat format, const std::string& name);

/// The name of a format, which is also the ending of its files.
std::string_view ending(PointFormat format);

/// "attachment; filename=...".
void suggest_file_name(HttpAnswer& answer, const std::string& file_name);

}  // namespace raywatch
