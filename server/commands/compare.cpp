#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "api/parameter_bounds.hpp"
#include "core/profile.hpp"
#include "server/commands/commands.hpp"
#include "server/commands/number_options.hpp"
#include "server/comparison_output.hpp"
#include "server/file_comparison.hpp"
#include "server/stopwatch.hpp"

namespace raywatch {
namespace {

constexpr const char* kCompareFooter = R"(
Reads PCD, PLY, LAS, PTX, XYZ and CSV text, and KITTI .bin. What a file does not say itself stands in FILE.json:
  {"captured_at": "2026-03-01T02:10:00Z", "frame": "sensor",
   "pose": {"position_m": [0, 0, 1.5], "orientation_xyzw": [0, 0, 0, 1]}}
A pose is needed for every file: without it there are no rays. Without times NEW is the later one.

Prints one JSON object: counts, changes and timings_ms.

Examples:
  raywatch compare tonight.pcd --against last_night.pcd
  raywatch compare new.las --against east.las --against west.las --profile survey --output classes.csv
  raywatch compare new.pcd --against old.pcd --grouping union --angle-deg 0.5 --range-m 0.1 --removed-output gone.csv

Exit codes: 0 done, 1 failed (a file cannot be written), 2 wrong arguments or input files.)";

constexpr RealBounds kAgreement_m{.min = 0.0, .max = 1e6};
constexpr RealBounds kDistance_m{.min = 0.0, .max = 1e6, .exclusive_min = true};
constexpr IntegerBounds kThreads{.min = 0, .max = 1024};

/// The command line as it was given; what is not given follows the profile and the grouping.
struct CompareOptions {
  std::string scan;
  std::vector<std::string> priors;
  std::string grouping = "consensus", profile = "indoor";
  std::optional<double> angle_deg, range_m, support_distance_m, growth_distance_m, foliage_distance_m,
      cluster_distance_m, min_range_m, max_range_m;
  std::optional<std::size_t> cluster_min_points;
  bool no_cluster = false, no_align = false;
  double contemporary_s = 0.0;
  int threads = 0;
  std::string output, removed_output;
};

CompareParameters parameters_of(const CompareOptions& options) {
  CompareParameters p = default_parameters(parse_profile(options.profile), parse_grouping(options.grouping));
  if (options.angle_deg) p.angle_rad = *options.angle_deg * std::numbers::pi / 180.0;
  p.range_m = options.range_m.value_or(p.range_m);
  p.support_distance_m = options.support_distance_m.value_or(p.support_distance_m);
  p.align = p.align && !options.no_align;
  p.growth_distance_m = options.growth_distance_m.value_or(p.growth_distance_m);
  p.foliage_distance_m = options.foliage_distance_m.value_or(p.foliage_distance_m);
  p.clustering = p.clustering && !options.no_cluster;
  p.cluster_distance_m = options.cluster_distance_m.value_or(p.cluster_distance_m);
  p.cluster_min_points = options.cluster_min_points.value_or(p.cluster_min_points);
  p.min_range_m = options.min_range_m.value_or(p.min_range_m);
  p.max_range_m = options.max_range_m.value_or(p.max_range_m);
  p.contemporary_tolerance =
      std::chrono::duration_cast<Duration>(std::chrono::duration<double>(options.contemporary_s));
  return p;
}

int compare_and_report(const CompareOptions& options) {
  Stopwatch total;
  const FileComparisonRequest request{.scan = options.scan,
                                      .priors = {options.priors.begin(), options.priors.end()},
                                      .parameters = parameters_of(options)};
  check_outputs(request, {options.output, options.removed_output});
  const FileComparison comparison = compare_files(request);
  Stopwatch write;
  if (!options.output.empty()) write_classes(options.output, comparison);
  if (!options.removed_output.empty()) write_removed(options.removed_output, comparison);
  const double write_ms = write.total_ms();
  std::cout << to_json(request, comparison, write_ms, total.total_ms()) << '\n' << std::flush;
  return std::cout ? kExitDone : kExitFailed;
}

int run_compare(const CompareOptions& options) {
  if (options.threads == 0) return compare_and_report(options);
  // So many, even if there are fewer cores.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.threads));
  tbb::task_arena arena(options.threads);
  return arena.execute([&] { return compare_and_report(options); });
}

}  // namespace

void add_compare(CLI::App& program, Run& run) {
  CLI::App* command = program.add_subcommand("compare", "Compare scan files without a daemon");
  const auto options = std::make_shared<CompareOptions>();
  command->footer(kCompareFooter);
  command->add_option("new", options->scan, "The scan that is compared")->required()->type_name("NEW");
  command->add_option("--against", options->priors, "An earlier scan; may be given several times")
      ->required()
      ->allow_extra_args(false)
      ->type_name("PRIOR");
  command->add_option("--grouping", options->grouping, "How the answers of several priors become one")
      ->check(CLI::IsMember({"union", "consensus"}))
      ->capture_default_str();
  command->add_option("--profile", options->profile, "The kind of place; decides what is not given")
      ->check(CLI::IsMember({"indoor", "outdoor", "survey"}))
      ->capture_default_str();
  command->add_option("--angle-deg", options->angle_deg, "Half-angle of the cone of prior returns asked about a point")
      ->check(within(kAngleBounds_deg));
  command->add_option("--range-m", options->range_m, "Range difference below which two returns agree")
      ->check(within(kAgreement_m));
  command
      ->add_option("--support-distance-m", options->support_distance_m,
                   "In a consensus, how rough surfaces are; 0: answers are not weighed")
      ->check(within(kThresholdBounds_m));
  command
      ->add_option("--growth-distance-m", options->growth_distance_m,
                   "In a consensus, how far a change grows over points that no prior supports")
      ->check(within(kThresholdBounds_m));
  command
      ->add_option("--foliage-distance-m", options->foliage_distance_m,
                   "In a consensus, how far around a change a prior must not look like foliage; 0: not asked")
      ->check(within(kThresholdBounds_m));
  command
      ->add_option("--cluster-distance-m", options->cluster_distance_m,
                   "Changed points nearer than this are one change")
      ->check(within(kDistance_m));
  command
      ->add_option("--cluster-min-points", options->cluster_min_points, "Changes of at most so many points are noise")
      ->check(within(kMinPointsBounds));
  command->add_flag("--no-cluster", options->no_cluster, "Report every changed point");
  command->add_flag("--no-align", options->no_align,
                    "Take all poses as given; else a consensus fits each prior to NEW");
  command->add_option("--min-range-m", options->min_range_m, "Nearer returns are ignored")
      ->check(within(kRangeBounds_m));
  command->add_option("--max-range-m", options->max_range_m, "Farther returns are ignored")
      ->check(within(kRangeBounds_m));
  command
      ->add_option("--contemporary-s", options->contemporary_s, "Scans no farther apart in time show the same moment")
      ->check(within(kContemporaryBounds_s))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "0: one a core")->check(within(kThreads))->capture_default_str();
  command->add_option("--output", options->output, "Every point of NEW with its class (.csv, .pcd or .ply)")
      ->type_name("FILE");
  command
      ->add_option("--removed-output", options->removed_output, "The removed points of the priors (.csv, .pcd or .ply)")
      ->type_name("FILE");
  command->callback([&run, options] { run = [options] { return run_compare(*options); }; });
}

}  // namespace raywatch
