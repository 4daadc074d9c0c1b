// PCL's GICP as a second opinion: it needs a search tree and twenty times the time, and must come to the same pose.

#include <doctest/doctest.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>

#include <numbers>

#include "core/align.hpp"
#include "tests/simulator/family.hpp"
#include "tests/simulator/registration.hpp"

namespace raywatch {
namespace {

using namespace simulator;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr double kDegree = std::numbers::pi / 180.0;

Cloud::Ptr thinned(const PointCloud& points) {
  auto whole = std::make_shared<Cloud>(), thin = std::make_shared<Cloud>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) whole->push_back({points.x_m[i], points.y_m[i], points.z_m[i]});
  }
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setLeafSize(0.15F, 0.15F, 0.15F);
  grid.setInputCloud(whole);
  grid.filter(*thin);
  return thin;
}

Pose gicp(const PointCloud& scan, const PointCloud& reference, const Pose& reference_from_scan) {
  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> fitting;
  fitting.setInputSource(thinned(scan));
  fitting.setInputTarget(thinned(reference));
  fitting.setMaxCorrespondenceDistance(0.2);
  fitting.setTransformationEpsilon(1e-6);
  Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  guess.topLeftCorner<3, 3>() = reference_from_scan.orientation.toRotationMatrix().cast<float>();
  guess.topRightCorner<3, 1>() = reference_from_scan.position_m.cast<float>();
  Cloud moved;
  fitting.align(moved, guess);
  const Eigen::Matrix4d found = fitting.getFinalTransformation().cast<double>();
  return {Eigen::Quaterniond(Eigen::Matrix3d(found.topLeftCorner<3, 3>())).normalized(), found.topRightCorner<3, 1>()};
}

TEST_CASE("PCL's GICP comes to the same pose, and is not nearer to the truth") {
  const Timeline timeline = make_timeline(Family::lab, {.seed = 3, .density = 0.3});
  const SimulatedScan reference = take_scan(timeline, timeline.moments.at(0));
  const SimulatedScan scan = take_scan(timeline, timeline.moments.at(4));
  const Pose truth = scan.true_world_from_sensor;
  const Pose said = disturbed(truth, {.position_sigma_m = 0.01, .angle_sigma_rad = 0.05 * kDegree}, 1);

  const PriorIndex scan_index = PriorIndex::build(scan.points, {}), index = PriorIndex::build(reference.points, {});
  const ScanView onto{reference.points, index, reference.true_world_from_sensor, reference.captured_at,
                      estimate_sensor(reference.points, index)};
  const ScanView view{scan.points, scan_index, said, scan.captured_at, estimate_sensor(scan.points, scan_index)};
  const Pose ours = align(view, {&onto, 1}, {}).correction * said;
  const Pose world_from_reference = reference.true_world_from_sensor;
  const Pose theirs = world_from_reference * gicp(scan.points, reference.points, world_from_reference.inverse() * said);

  CHECK((ours.position_m - theirs.position_m).norm() < 0.012);
  CHECK(angle_between_rad(ours, theirs) < 0.08 * kDegree);
  CHECK((ours.position_m - truth.position_m).norm() <= (theirs.position_m - truth.position_m).norm() + 0.001);
}

}  // namespace
}  // namespace raywatch
