#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "storage/comparisons.hpp"
#include "storage/payloads.hpp"
#include "storage/scans.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {

/// Whole seconds after the start of 2026.
Time at_second(std::int64_t seconds);

/// Options for a store in `data_dir` that does not mind how full the disk of the test is.
StoreOptions options_for(const std::filesystem::path& data_dir);

/// A cloud of points on a sphere-like shell, every one different and all decided by `seed`.
PointCloud cloud_of(std::size_t points, std::uint32_t seed);
bool same_bits(const PointCloud& a, const PointCloud& b);
Panorama empty_panorama();

Site add_site(Store& store, const std::string& name);
Sensor add_sensor(Store& store, const std::string& name, SiteId site);

/// What is needed to say which scan is meant; the rest of the record is plain.
struct ScanSketch {
  Time captured_at;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};
ScanRecord sketched_scan(const Sensor& sensor, const ScanSketch& sketch);
/// Inserts a record without a payload.
ScanRecord add_scan(Store& store, const Sensor& sensor, const ScanSketch& sketch);
/// Puts the points and inserts their record.
ScanRecord add_scan_with_points(Store& store, const Sensor& sensor, const ScanSketch& sketch, const PointCloud& points);

ComparisonRecord add_comparison(Store& store, ScanId scan, Watching watching = Watching::no);
/// A change whose bounds are the cube of side 1 m around a place.
Change change_at(const Eigen::Vector3d& place_m, ChangeKind kind = ChangeKind::added);
/// Starts the next job of the site and finishes it with these changes.
Job finish_next_job(Store& store, SiteId site, const std::vector<Change>& changes = {});

/// How many payloads lie in the files of a store, with or without an owner.
std::size_t stored_payloads(const Store& store);

/// A store in a directory of its own, with one site and one sensor.
struct StoreFixture {
  TempDir directory;
  Store store{options_for(directory.path())};
  Site site = add_site(store, "hall");
  Sensor sensor = add_sensor(store, "door", site.id);
};

}  // namespace raywatch
