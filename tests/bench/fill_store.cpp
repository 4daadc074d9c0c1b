// Fills a data directory with a large store, on which a daemon can be measured: `raywatch-fill-store DIR`.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "core/panorama.hpp"
#include "core/sensor.hpp"
#include "storage/alerts.hpp"
#include "storage/tracks.hpp"
#include "tests/simulator/family.hpp"
#include "tests/simulator/simulated_scan.hpp"
#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

struct Amounts {
  std::int64_t scans = 1'000'000;  ///< of the site "large": metadata; all of a vantage share one payload
  std::int64_t changes = 100'000;  ///< of it, four a comparison, each with a track and every tenth with an alert
  std::int64_t history = 10'000;   ///< scans of the site "long", one vantage, each with its own points
};

constexpr int kSide = 10;  // vantages stand on a square grid
constexpr double kApart_m = 4.0;
constexpr std::int64_t kBatch = 10'000;

/// One scan of the simulated yard, taken with noise that the number decides.
PointCloud yard_points(std::uint64_t number) {
  using namespace simulator;
  const Timeline story = make_timeline(Family::stream, {.density = 0.3, .scans = 1});
  Moment moment = story.moments.front();
  moment.plan.seed = number;
  return simulator::take_scan(story, moment).points;
}

/// A scan of one vantage of the large site.
ScanRecord large_scan(const Sensor& sensor, const ScanRecord& pattern, std::int64_t number) {
  const std::int64_t vantage = number % (kSide * kSide);
  const Eigen::Vector3d place_m(kApart_m * static_cast<double>(vantage % kSide),
                                kApart_m * static_cast<double>(vantage / kSide), 2.0);
  ScanRecord scan = sketched_scan(sensor, {.captured_at = at_second(10 * number), .position_m = place_m});
  scan.points = pattern.points;
  scan.payload = pattern.payload;
  scan.estimated = pattern.estimated;
  scan.registration.state = RegistrationState::good;
  scan.state = ScanState::compared;
  return scan;
}

ScanRecord put_points(Store& store, const Sensor& sensor, Time captured_at, const PointCloud& points) {
  ScanRecord scan = sketched_scan(sensor, {.captured_at = captured_at, .position_m = {0.0, 0.0, 2.0}});
  scan.points = points.size();
  scan.estimated = estimate_sensor(points);
  scan.payload = store.payloads().put_scan(sensor.site, captured_at, points, make_panorama(points, {}));
  return scan;
}

void fill_large(Store& store, const Amounts& amounts) {
  const Site site = add_site(store, "large");
  const Sensor sensor = add_sensor(store, "large-sensor", site.id);
  const ScanRecord pattern = put_points(store, sensor, at_second(0), yard_points(1));
  for (std::int64_t first = 0; first < amounts.scans; first += kBatch) {
    store.write([&](Transaction& transaction) {
      for (std::int64_t n = first; n < std::min(amounts.scans, first + kBatch); ++n) {
        insert_scan(transaction, large_scan(sensor, pattern, n));
      }
    });
    std::cout << "\rscans: " << first + kBatch << std::flush;
  }
  std::cout << '\n';
}

Change change_number(std::int64_t number) {
  const auto n = static_cast<double>(number);
  Change change = change_at({std::fmod(0.37 * n, 40.0), std::fmod(0.11 * n, 40.0), 0.5},
                            number % 2 == 0 ? ChangeKind::added : ChangeKind::removed);
  change.volume_m3 = 0.01 * std::fmod(n, 100.0);
  return change;
}

/// A track and, for every tenth, an alert.
void add_track(Transaction& transaction, const ScanRecord& scan, ChangeId change, std::int64_t number) {
  TrackRecord track;
  track.track.latest = change_number(number);
  track.track.first_seen_at = track.track.last_seen_at = scan.captured_at;
  track.track.state = TrackState::gone;
  track.site = scan.site;
  track.first_scan = track.last_scan = scan.id;
  track.latest_change = change;
  const TrackId id = insert_track(transaction, track);
  set_track(transaction, change, id);
  if (number % 10 != 0) return;
  AlertRecord alert;
  alert.site = scan.site;
  alert.cause = "change";
  alert.title = "Something was added.";
  alert.track = id;
  alert.scan = scan.id;
  alert.opened_at = scan.captured_at;
  alert.state = number % 1000 == 0 ? AlertState::open : AlertState::resolved;
  open_alert(transaction, alert, "");
}

void add_changes(Store& store, const Amounts& amounts) {
  constexpr std::int64_t kEach = 4, kPerBatch = 1000;
  const std::int64_t comparisons = amounts.changes / kEach, step = amounts.scans / comparisons;
  for (std::int64_t first = 0; first < comparisons; first += kPerBatch) {
    store.write([&](Transaction& transaction) {
      for (std::int64_t c = first; c < std::min(comparisons, first + kPerBatch); ++c) {
        const ScanRecord scan = find_scan(transaction, ScanId{1 + c * step}).value();
        insert_comparison(transaction, scan.id, PreviousReference{}, {}, scan.captured_at, Watching::yes);
        const Job job = start_job(transaction, scan.site).value();
        ComparisonResult result;
        for (std::int64_t k = 0; k < kEach; ++k) result.changes.push_back(change_number(c * kEach + k));
        const auto ids = finish_job(transaction, job, result, scan.captured_at).value();
        for (std::int64_t k = 0; k < kEach; ++k) {
          add_track(transaction, scan, ids[static_cast<std::size_t>(k)], c * kEach + k);
        }
      }
    });
    std::cout << "\rchanges: " << kEach * (first + kPerBatch) << std::flush;
  }
  std::cout << '\n';
}

void fill_long(Store& store, const Amounts& amounts) {
  constexpr std::int64_t kDifferent = 20;
  const Site site = add_site(store, "long");
  const Sensor sensor = add_sensor(store, "long-sensor", site.id);
  std::vector<PointCloud> clouds;
  for (std::int64_t k = 0; k < kDifferent; ++k) clouds.push_back(yard_points(static_cast<std::uint64_t>(k)));
  for (std::int64_t n = 0; n < amounts.history; ++n) {
    const ScanRecord scan =
        put_points(store, sensor, at_second(60 * n), clouds[static_cast<std::size_t>(n % kDifferent)]);
    store.write([&](Transaction& transaction) { insert_scan(transaction, scan); });
    if (n % 100 == 99) std::cout << "\rscans with points: " << n + 1 << " of " << scan.points << std::flush;
  }
  std::cout << '\n';
}

}  // namespace
}  // namespace raywatch

int main(int argc, char** argv) {
  CLI::App app("Fills a new data directory with a large store, to measure a daemon on it.");
  std::filesystem::path directory;
  raywatch::Amounts amounts;
  app.add_option("directory", directory, "New or empty")->required();
  app.add_option("--scans", amounts.scans, "Scans of the site 'large', without points of their own")
      ->capture_default_str();
  app.add_option("--changes", amounts.changes, "Changes of the site 'large'")->capture_default_str();
  app.add_option("--history", amounts.history, "Scans of the site 'long', with points")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  raywatch::Store store(raywatch::options_for(directory));
  raywatch::fill_large(store, amounts);
  raywatch::add_changes(store, amounts);
  raywatch::fill_long(store, amounts);
}
