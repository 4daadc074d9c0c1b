#include "tests/storage/store_fixture.hpp"

#include <cstring>
#include <random>

#include "storage/sqlite.hpp"

namespace raywatch {
namespace {

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

}  // namespace

Time at_second(std::int64_t seconds) {
  constexpr std::int64_t kStartOf2026_s = 1'767'225'600;
  return Time(std::chrono::seconds(kStartOf2026_s + seconds));
}

StoreOptions options_for(const std::filesystem::path& data_dir) {
  return {.data_dir = data_dir, .readers = 2, .min_free_bytes = 0};
}

PointCloud cloud_of(std::size_t points, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate_m(-20.0f, 20.0f);
  PointCloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    cloud.push_back(coordinate_m(random), coordinate_m(random), coordinate_m(random));
  }
  return cloud;
}

bool same_bits(const PointCloud& a, const PointCloud& b) {
  return same_bits(a.x_m, b.x_m) && same_bits(a.y_m, b.y_m) && same_bits(a.z_m, b.z_m) &&
         same_bits(a.intensity, b.intensity) && a.grid == b.grid;
}

Panorama empty_panorama() { return {std::vector<std::uint16_t>(Panorama::kRows * Panorama::kColumns)}; }

Site add_site(Store& store, const std::string& name) {
  Site site;
  site.name = name;
  return store.write([&](Transaction& transaction) { return insert_site(transaction, site, at_second(0)); });
}

Sensor add_sensor(Store& store, const std::string& name, SiteId site) {
  Sensor sensor;
  sensor.name = name;
  sensor.site = site;
  return store.write([&](Transaction& transaction) { return insert_sensor(transaction, sensor, at_second(0)); });
}

ScanRecord sketched_scan(const Sensor& sensor, const ScanSketch& sketch) {
  ScanRecord scan;
  scan.site = sensor.site;
  scan.sensor = sensor.id;
  scan.captured_at = sketch.captured_at;
  scan.received_at = sketch.captured_at + std::chrono::seconds(1);
  scan.pose.position_m = sketch.position_m;
  scan.sha256 = std::to_string(sketch.captured_at.time_since_epoch().count());
  return scan;
}

ScanRecord add_scan(Store& store, const Sensor& sensor, const ScanSketch& sketch) {
  return store.write([&](Transaction& transaction) { return insert_scan(transaction, sketched_scan(sensor, sketch)); });
}

ScanRecord add_scan_with_points(Store& store, const Sensor& sensor, const ScanSketch& sketch,
                                const PointCloud& points) {
  ScanRecord scan = sketched_scan(sensor, sketch);
  scan.points = points.size();
  scan.payload = store.payloads().put_scan(sensor.site, sketch.captured_at, points, empty_panorama());
  scan.stored_bytes = store.payloads().stored_bytes(scan.payload);
  return store.write([&](Transaction& transaction) { return insert_scan(transaction, scan); });
}

ComparisonRecord add_comparison(Store& store, ScanId scan, Watching watching) {
  return store.write([&](Transaction& transaction) {
    return insert_comparison(transaction, scan, PreviousReference{}, CompareParameters{}, at_second(0), watching);
  });
}

Change change_at(const Eigen::Vector3d& place_m, ChangeKind kind) {
  const Eigen::Vector3d half_m = Eigen::Vector3d::Constant(0.5);
  Change change;
  change.kind = kind;
  change.centroid_m = place_m;
  change.bounds_m = Eigen::AlignedBox3d(place_m - half_m, place_m + half_m);
  change.box = {place_m, 2.0 * half_m, Eigen::Quaterniond::Identity()};
  change.volume_m3 = 1.0;
  change.points = 50;
  return change;
}

Job finish_next_job(Store& store, SiteId site, const std::vector<Change>& changes) {
  return store.write([&](Transaction& transaction) {
    const Job job = start_job(transaction, site).value();
    ComparisonResult result;
    result.changes = changes;
    finish_job(transaction, job, result, at_second(1));
    return job;
  });
}

std::size_t stored_payloads(const Store& store) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(store.data_dir() / "payload")) {
    if (entry.path().extension() != ".db") continue;
    Database database(entry.path(), Database::Access::read_only);
    count += database.find<std::size_t>("SELECT count(*) FROM payloads").value();
  }
  return count;
}

}  // namespace raywatch
