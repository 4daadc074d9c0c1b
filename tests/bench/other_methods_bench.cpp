// What others do, on the same scenes: the published method written plainly, and PCL's octree change detector, which
// compares voxels and knows neither free nor unseen space.

#include <benchmark/benchmark.h>
#include <pcl/octree/octree_pointcloud_changedetector.h>
#include <pcl/point_types.h>
#include <tbb/task_arena.h>

#include "core/index_kernels.hpp"
#include "tests/bench/bench_scenes.hpp"
#include "tests/bench/plain_method.hpp"

namespace raywatch::bench {
namespace {

void set_points(benchmark::State& state, std::size_t points) {
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>(points), benchmark::Counter::kIsIterationInvariantRate);
}

/// Index of one prior and one direction, as the others below.
void plain_method(benchmark::State& state, SceneSize size) {
  const BenchScene& s = scene(size);
  const Pose prior_from_scan = s.other_pose.world_from_sensor.inverse() * s.scan.world_from_sensor;
  for (auto _ : state) {
    const PlainMethod method(s.other_pose.points, s.thresholds);
    benchmark::DoNotOptimize(method.free(s.scan.points, prior_from_scan));
  }
  set_points(state, s.scan.points.size());
}

void raywatch_method(benchmark::State& state, SceneSize size) {
  const BenchScene& s = scene(size);
  const Pose prior_from_scan = s.other_pose.world_from_sensor.inverse() * s.scan.world_from_sensor;
  std::vector<std::uint8_t> valid(s.scan.points.size());
  std::vector<Answer> answers(valid.size());
  tbb::task_arena arena(1);
  for (auto _ : state) {
    arena.execute([&] {
      find_usable(planes_of(s.scan.points), {}, valid.data());
      const PriorIndex index = PriorIndex::build(s.other_pose.points, {});
      ask(index, s.scan.points, valid, prior_from_scan, s.thresholds, answers);
    });
    benchmark::ClobberMemory();
  }
  set_points(state, s.scan.points.size());
}

pcl::PointCloud<pcl::PointXYZ>::Ptr in_world(const BenchScan& scan) {
  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3f p = (scan.world_from_sensor * scan.points[i].cast<double>()).cast<float>();
    if (p.allFinite()) cloud->emplace_back(p.x(), p.y(), p.z());
  }
  return cloud;
}

void pcl_octree(benchmark::State& state, SceneSize size) {
  const BenchScene& s = scene(size);
  const auto before = in_world(s.other_pose), after = in_world(s.scan);
  for (auto _ : state) {
    pcl::octree::OctreePointCloudChangeDetector<pcl::PointXYZ> octree(static_cast<float>(s.thresholds.range_m));
    octree.setInputCloud(before);
    octree.addPointsFromInputCloud();
    octree.switchBuffers();
    octree.setInputCloud(after);
    octree.addPointsFromInputCloud();
    pcl::Indices changed;
    octree.getPointIndicesFromNewVoxels(changed);
    benchmark::DoNotOptimize(changed.data());
  }
  set_points(state, after->size());
}

void add(const std::string& name, void (*f)(benchmark::State&, SceneSize), SceneSize size) {
  benchmark::RegisterBenchmark(name.c_str(), [f, size](benchmark::State& state) { f(state, size); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

const bool registered = [] {
  for (const auto& [where, size] :
       {std::pair{"dense_512k", SceneSize::dense}, std::pair{"survey_1.4M", SceneSize::survey}}) {
    add(std::string("one_direction_raywatch/") + where, raywatch_method, size);
    add(std::string("one_direction_plain_method/") + where, plain_method, size);
    add(std::string("one_direction_pcl_octree/") + where, pcl_octree, size);
  }
  return true;
}();

}  // namespace
}  // namespace raywatch::bench
