#include "server/file_comparison.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/index_scan.hpp"
#include "core/prior_index.hpp"
#include "core/sensor.hpp"
#include "server/stopwatch.hpp"
#include "storage/formats/naming_file.hpp"
#include "storage/formats/scan_file.hpp"
#include "storage/formats/side_car.hpp"

namespace raywatch {
namespace {

/// A file that cannot be read is wrong input, as one that is broken.
std::vector<DecodedScan> read_scans(const std::filesystem::path& file) {
  try {
    const ScanHints hints = read_side_car(file);
    return naming(file, [&] { return read_scan_file(file, hints); });
  } catch (const StorageError& error) {
    throw InvalidInput(error.what());
  }
}

FileScan read_one_scan(const std::filesystem::path& file) {
  std::vector<DecodedScan> scans = read_scans(file);
  if (scans.size() != 1) {
    throw InvalidInput(file.string() + ": holds " + std::to_string(scans.size()) + " scans; one is needed");
  }
  DecodedScan& scan = scans.front();
  if (!scan.world_from_sensor) {
    throw InvalidInput(file.string() + ": nothing says from where it was taken. Write the pose into " + file.string() +
                       ".json: " + kPoseInSideCar + " (an identity VIEWPOINT counts as absent)");
  }
  return {std::move(scan.points), *scan.world_from_sensor, scan.captured_at};
}

/// The scan first, then the priors.
std::vector<FileScan> read_all(const FileComparisonRequest& request) {
  std::vector<std::filesystem::path> files = {request.scan};
  files.insert(files.end(), request.priors.begin(), request.priors.end());
  std::vector<FileScan> scans(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) { scans[i] = read_one_scan(files[i]); });
  return scans;
}

/// Map coordinates are too large for float; near zero nothing is moved, so that results keep the user's numbers.
Eigen::Vector3d common_origin_m(const Pose& world_from_sensor) {
  constexpr double kFar_m = 10e3;
  const Eigen::Vector3d& position_m = world_from_sensor.position_m;
  return position_m.norm() > kFar_m ? Eigen::Vector3d(position_m.array().round()) : Eigen::Vector3d::Zero();
}

std::vector<ScanIndex> index_all(const std::vector<FileScan>& scans, const CompareParameters& parameters) {
  std::vector<std::optional<ScanIndex>> built(scans.size());
  tbb::parallel_for(std::size_t{0}, scans.size(),
                    [&](std::size_t i) { built[i].emplace(index_scan(scans[i].points, {}, parameters)); });
  std::vector<ScanIndex> indexed;
  for (std::optional<ScanIndex>& file : built) indexed.push_back(std::move(*file));
  return indexed;
}

/// Times for all, so that what has none keeps its order: priors before the scan, farther than the tolerance.
std::vector<Time> capture_times(const std::vector<FileScan>& scans, Duration tolerance) {
  const Duration apart = tolerance + Duration(1);
  std::optional<Time> scan_time = scans.front().captured_at;
  if (!scan_time) {
    Time latest{};
    for (const FileScan& prior : scans) latest = std::max(latest, prior.captured_at.value_or(Time{}));
    scan_time = shifted(latest, apart);
  }
  std::vector<Time> times = {*scan_time};
  for (std::size_t i = 1; i < scans.size(); ++i)
    times.push_back(scans[i].captured_at.value_or(shifted(*scan_time, -apart)));
  return times;
}

AlignedPriors aligned_priors(const ScanView& scan, std::span<const ScanView> priors,
                             const CompareParameters& parameters) {
  if (refines_poses(parameters)) return align_priors(scan, priors, {});
  AlignedPriors as_given{.alignments = std::vector<Alignment>(priors.size()),
                         .usable = {priors.begin(), priors.end()},
                         .places = std::vector<std::uint32_t>(priors.size()),
                         .warnings = {}};
  std::iota(as_given.places.begin(), as_given.places.end(), 0U);
  return as_given;
}

/// Moves the priors to where they were compared, and says how far that was.
std::vector<FileRegistration> apply_corrections(const AlignedPriors& aligned, std::span<FileScan> priors) {
  std::vector<FileRegistration> registrations;
  for (std::size_t p = 0; p < priors.size(); ++p) {
    const Alignment& alignment = aligned.alignments[p];
    registrations.push_back({alignment, size_of(alignment.correction, priors[p].world_from_sensor)});
    priors[p].world_from_sensor = alignment.correction * priors[p].world_from_sensor;
  }
  return registrations;
}

}  // namespace

FileComparison compare_files(const FileComparisonRequest& request) {
  Stopwatch watch;
  FileComparison done;
  std::vector<FileScan> scans = read_all(request);
  done.origin_m = common_origin_m(scans.front().world_from_sensor);
  for (FileScan& scan : scans) scan.world_from_sensor.position_m -= done.origin_m;
  const std::vector<Time> times = capture_times(scans, request.parameters.contemporary_tolerance);
  done.timings.read_ms = watch.lap_ms();

  const std::vector<ScanIndex> indexed = index_all(scans, request.parameters);
  done.timings.index_ms = watch.lap_ms();

  std::vector<ScanView> views;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    views.push_back({scans[i].points, indexed[i].index, scans[i].world_from_sensor, times[i], indexed[i].estimated});
  }
  const ScanView& scan = views.front();
  const AlignedPriors aligned = aligned_priors(scan, std::span(views).subspan(1), request.parameters);
  done.timings.align_ms = watch.lap_ms();

  Detection detection = detect(scan, aligned.usable, request.parameters);
  done.timings.detect_ms = watch.lap_ms();

  done.result = form_changes(scan, aligned.usable, request.parameters, std::move(detection));
  restore_places(aligned, done.result);
  done.timings.cluster_ms = watch.lap_ms();

  if (refines_poses(request.parameters)) done.registrations = apply_corrections(aligned, std::span(scans).subspan(1));
  done.scan = std::move(scans.front());
  done.priors.assign(std::make_move_iterator(scans.begin() + 1), std::make_move_iterator(scans.end()));
  return done;
}

}  // namespace raywatch
