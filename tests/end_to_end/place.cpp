#include "tests/end_to_end/place.hpp"

#include <fstream>
#include <sstream>

#include "storage/formats/side_car.hpp"
#include "storage/formats/write.hpp"
#include "tests/simulator/simulated_scan.hpp"
#include "tests/simulator/wall_and_box.hpp"

namespace raywatch::test {

using namespace raywatch::simulator;

PlaceScan scan_place(const PlaceState& state, int number) {
  WallAndBox layout{.wall_distance_m = 10.0};
  if (state.box) layout.box_center_m = Eigen::Vector3d(5.0, 0.0, 0.0);
  Scene scene = wall_and_box(layout);
  if (state.person_y_m) {
    scene.add(Box{{Eigen::Quaterniond::Identity(), {7.0, *state.person_y_m, 0.0}}, {0.3, 0.3, 0.9}}, kBoxState + 1);
  }
  Scanner scanner = grid_scanner({.lowest_elevation_rad = radians(-15.0), .highest_elevation_rad = radians(15.0)});
  scanner.max_range_m = 20.0;
  scanner.errors.range_noise_m = 0.002;  // no two scans have the same bytes
  SimulatedScan scan = take_scan(RayCaster(scene), scanner, exact_plan({}, static_cast<std::uint64_t>(number)));
  return {std::move(scan.points), {}, parse_rfc3339("2026-03-01T08:00:00Z") + std::chrono::minutes(number)};
}

std::string PlaceScan::pcd() const {
  std::ostringstream out;
  write_scan_pcd(out, points, {});
  return std::move(out).str();
}

std::string PlaceScan::pose_text() const {
  const Eigen::Vector3d& p = world_from_sensor.position_m;
  const Eigen::Quaterniond& q = world_from_sensor.orientation;
  std::ostringstream text;
  text.precision(17);
  text << p.x() << ',' << p.y() << ',' << p.z() << ',' << q.x() << ',' << q.y() << ',' << q.z() << ',' << q.w();
  return std::move(text).str();
}

std::string PlaceScan::time_text() const { return format_rfc3339(captured_at); }

std::filesystem::path PlaceScan::write(const std::filesystem::path& folder, const std::string& name) const {
  const std::filesystem::path file = folder / (name + ".pcd");
  std::ofstream(file, std::ios::binary) << pcd();
  write_side_car(file, {.pose = world_from_sensor, .captured_at = captured_at});
  return file;
}

}  // namespace raywatch::test
