#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>

#include "core/index_kernels.hpp"
#include "core/profile.hpp"
#include "tests/bench/bench_scenes.hpp"

namespace raywatch::bench {
namespace {

void set_points(benchmark::State& state, std::size_t points) {
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>(points), benchmark::Counter::kIsIterationInvariantRate);
}

/// The limit that everything is measured against: nothing but range, azimuth and elevation of every point.
void bare_transform(benchmark::State& state, SceneSize size) {
  const PointCloud& points = scene(size).scan.points;
  std::vector<float> range(points.size()), azimuth(points.size()), elevation(points.size());
  for (auto _ : state) {
    to_spherical(planes_of(points), range.data(), azimuth.data(), elevation.data());
    benchmark::DoNotOptimize(range.data());
    benchmark::ClobberMemory();
  }
  set_points(state, points.size());
}

void build_index(benchmark::State& state, SceneSize size) {
  const PointCloud& points = scene(size).scan.points;
  std::size_t bytes = 0;
  tbb::task_arena arena(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    arena.execute([&] {
      const PriorIndex index = PriorIndex::build(points, {});
      benchmark::DoNotOptimize(bytes = index.bytes());
    });
  }
  set_points(state, points.size());
  state.counters["bytes/point"] = static_cast<double>(bytes) / static_cast<double>(points.size());
}

void ask_prior(benchmark::State& state, SceneSize size, bool same_pose) {
  const BenchScene& s = scene(size);
  const BenchScan& prior = same_pose ? s.same_pose : s.other_pose;
  const Pose prior_from_scan = prior.world_from_sensor.inverse() * s.scan.world_from_sensor;
  std::vector<std::uint8_t> valid(s.scan.points.size());
  find_usable(planes_of(s.scan.points), {}, valid.data());
  std::vector<Answer> answers(s.scan.points.size());
  tbb::task_arena arena(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    arena.execute([&] { ask(prior.index, s.scan.points, valid, prior_from_scan, s.thresholds, answers); });
    benchmark::ClobberMemory();
  }
  set_points(state, answers.size());
  std::array<std::size_t, 5> counts{};
  for (const Answer answer : answers) ++counts[static_cast<std::size_t>(answer)];
  constexpr const char* kNames[] = {"unseen%", "free%", "supported%", "occluded%", "ambiguous%"};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    state.counters[kNames[k]] = 100.0 * static_cast<double>(counts[k]) / static_cast<double>(answers.size());
  }
}

/// Only whether points are free: the question of the published method.
void find_free_points(benchmark::State& state, SceneSize size, bool same_pose) {
  const BenchScene& s = scene(size);
  const BenchScan& prior = same_pose ? s.same_pose : s.other_pose;
  const Pose prior_from_scan = prior.world_from_sensor.inverse() * s.scan.world_from_sensor;
  std::vector<std::uint8_t> valid(s.scan.points.size()), free(s.scan.points.size());
  find_usable(planes_of(s.scan.points), {}, valid.data());
  tbb::task_arena arena(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    arena.execute([&] { find_free(prior.index, s.scan.points, valid, prior_from_scan, s.thresholds, free); });
    benchmark::ClobberMemory();
  }
  set_points(state, free.size());
}

/// How the cost of asking grows with T_a, given as a multiple of the spacing of the shots (x 10).
void ask_at_angle(benchmark::State& state, SceneSize size, bool same_pose) {
  const BenchScene& s = scene(size);
  const BenchScan& prior = same_pose ? s.same_pose : s.other_pose;
  const Pose prior_from_scan = prior.world_from_sensor.inverse() * s.scan.world_from_sensor;
  const double spacing_rad = prior.sensor.angular_resolution_rad->maxCoeff();
  const Thresholds thresholds{0.1 * static_cast<double>(state.range(0)) * spacing_rad, s.thresholds.range_m};
  std::vector<std::uint8_t> valid(s.scan.points.size());
  find_usable(planes_of(s.scan.points), {}, valid.data());
  std::vector<Answer> answers(valid.size());
  tbb::task_arena arena(1);
  for (auto _ : state) {
    arena.execute([&] { ask(prior.index, s.scan.points, valid, prior_from_scan, thresholds, answers); });
    benchmark::ClobberMemory();
  }
  set_points(state, answers.size());
}

void detect_both_ways(benchmark::State& state, SceneSize size, Grouping grouping, bool same_pose) {
  const BenchScene& s = scene(size);
  CompareParameters parameters =
      default_parameters(size == SceneSize::dense ? Profile::indoor : Profile::survey, grouping);
  parameters.angle_rad = s.thresholds.angle_rad;
  if (grouping == Grouping::union_) parameters.range_m = s.thresholds.range_m;
  const ScanView prior = same_pose ? s.same_pose.view() : s.other_pose.view();
  std::size_t added = 0;
  tbb::task_arena arena(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    arena.execute([&] {
      const Detection detection = detect(s.scan.view(), std::span(&prior, 1), parameters);
      added =
          static_cast<std::size_t>(std::count(detection.classes.begin(), detection.classes.end(), PointClass::added));
    });
  }
  set_points(state, s.scan.points.size() + prior.points.size());
  state.counters["added"] = static_cast<double>(added);
}

void register_all() {
  const std::pair<const char*, SceneSize> sizes[] = {
      {"dense_512k", SceneSize::dense}, {"survey_1.4M", SceneSize::survey}, {"survey_5.6M", SceneSize::surveys}};
  const auto name = [](const char* what, const char* where) { return std::string(what) + "/" + where; };
  for (const auto& [where, size] : sizes) {
    const auto add = [&, where = where](const char* what, auto f, bool threads = true) {
      auto* b = benchmark::RegisterBenchmark(name(what, where).c_str(), f)->Unit(benchmark::kMillisecond);
      b->UseRealTime();
      if (threads) b->Arg(1)->Arg(2);
    };
    const SceneSize s = size;
    add(
        "transform", [s](benchmark::State& state) { bare_transform(state, s); }, false);
    add("index", [s](benchmark::State& state) { build_index(state, s); });
    add("ask_same_pose", [s](benchmark::State& state) { ask_prior(state, s, true); });
    add("ask_other_pose", [s](benchmark::State& state) { ask_prior(state, s, false); });
    add("find_free_same_pose", [s](benchmark::State& state) { find_free_points(state, s, true); });
    add("find_free_other_pose", [s](benchmark::State& state) { find_free_points(state, s, false); });
    for (const auto& [pose, same] : {std::pair{"same_pose", true}, std::pair{"other_pose", false}}) {
      const auto ask_angle = [s, same = same](benchmark::State& state) { ask_at_angle(state, s, same); };
      auto* angles = benchmark::RegisterBenchmark(
          name((std::string("ask_tenths_of_spacing_") + pose).c_str(), where).c_str(), ask_angle);
      angles->Unit(benchmark::kMillisecond)->UseRealTime();
      for (const int tenths : {16, 30, 50, 80}) angles->Arg(tenths);
      for (const auto& [grouping_name, grouping] :
           {std::pair{"union", Grouping::union_}, std::pair{"consensus", Grouping::consensus}}) {
        add((std::string("detect_") + grouping_name + "_" + pose).c_str(),
            [s, same = same, grouping = grouping](benchmark::State& state) {
              detect_both_ways(state, s, grouping, same);
            });
      }
    }
  }
}

}  // namespace
}  // namespace raywatch::bench

int main(int argc, char** argv) {
  raywatch::bench::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
