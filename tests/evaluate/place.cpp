#include "tests/evaluate/place.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "storage/formats/scan_file.hpp"
#include "storage/formats/side_car.hpp"
#include "tests/simulator/scene_folder.hpp"

namespace raywatch::evaluation {
namespace {

using Path = std::filesystem::path;

nlohmann::json read_manifest(const Path& folder) {
  const Path path = folder / "manifest.json";
  std::ifstream in(path);
  if (!in) {
    throw InvalidInput(folder.string() +
                       ": has no readable manifest.json, so nothing says what is true of its scans; " +
                       "raywatch-simulate writes such folders");
  }
  try {
    return nlohmann::json::parse(in);
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput(path.string() + ": " + error.what());
  }
}

std::vector<StateId> read_labels_of(const Path& scan_file, std::size_t points) {
  const Path path = scan_file.string() + ".labels";
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InvalidInput(path.string() + ": missing; every scan needs a label for each of its points");
  std::vector<StateId> labels;
  try {
    labels = simulator::read_labels(in);
  } catch (const InvalidInput& error) {
    throw InvalidInput(path.string() + ": " + error.what());
  }
  if (labels.size() != points) {
    throw InvalidInput(path.string() + ": has " + std::to_string(labels.size()) + " labels for " +
                       std::to_string(points) + " points");
  }
  return labels;
}

DecodedScan read_points(const Path& file) {
  std::vector<DecodedScan> decoded;
  try {
    decoded = read_scan_file(file, read_side_car(file));
  } catch (const Error& error) {
    throw InvalidInput(file.string() + ": " + error.what());
  }
  if (decoded.size() != 1) throw InvalidInput(file.string() + ": must hold exactly one scan");
  if (!decoded[0].world_from_sensor || !decoded[0].captured_at) {
    throw InvalidInput(file.string() +
                       ": nothing says from where and when it was taken; give pose and captured_at in " +
                       file.string() + ".json");
  }
  return std::move(decoded[0]);
}

SimulatedScan read_scan(const Path& folder, const nlohmann::json& entry) {
  const Path file = folder / entry.at("file").get<std::string>();
  DecodedScan decoded = read_points(file);
  SimulatedScan scan;
  scan.labels = read_labels_of(file, decoded.points.size());
  scan.points = std::move(decoded.points);
  scan.true_world_from_sensor = scan.reported_world_from_sensor = *decoded.world_from_sensor;
  scan.captured_at = *decoded.captured_at;
  scan.sensor = decoded.sensor.value_or("");
  scan.present = entry.at("present").get<std::vector<StateId>>();
  std::ranges::sort(scan.present);
  return scan;
}

void sort_by_time(Place& place) { std::ranges::stable_sort(place.scans, {}, &SimulatedScan::captured_at); }

/// Comparisons carry places in single precision, for which map coordinates are too large.
void move_near_origin(Place& place) {
  constexpr double kFar_m = 10e3;
  const Eigen::Vector3d origin_m = place.scans.front().reported_world_from_sensor.position_m.array().round();
  if (origin_m.norm() <= kFar_m) return;
  for (SimulatedScan& scan : place.scans) {
    scan.reported_world_from_sensor.position_m -= origin_m;
    scan.true_world_from_sensor.position_m -= origin_m;
  }
}

}  // namespace

Profile profile_of(simulator::Family family) {
  switch (family) {
    case simulator::Family::sim:
    case simulator::Family::lab:
      return Profile::indoor;
    case simulator::Family::carpark:
    case simulator::Family::yard:
    case simulator::Family::stream:
      return Profile::outdoor;
    case simulator::Family::mine:
    case simulator::Family::pit:
      break;
  }
  return Profile::survey;
}

Place simulate_place(simulator::Family family, const simulator::FamilyOptions& options) {
  const simulator::Timeline timeline = simulator::make_timeline(family, options);
  Place place;
  place.name = std::string(to_string(family)) + (options.hard ? " hard" : "") + " " + std::to_string(options.seed);
  for (const simulator::Moment& moment : timeline.moments) place.scans.push_back(take_scan(timeline, moment));
  for (const simulator::ObjectState& state : timeline.objects) {
    place.states.push_back({state.id, state.name, state.kind});
  }
  sort_by_time(place);
  return place;
}

Place read_place(const Path& folder) {
  const nlohmann::json manifest = read_manifest(folder);
  Place place;
  place.name = folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
  try {
    for (const auto& entry : manifest.at("scans")) place.scans.push_back(read_scan(folder, entry));
    for (const auto& state : manifest.at("objects")) {
      place.states.push_back(
          {state.at("state").get<StateId>(), state.at("name").get<std::string>(), state.at("kind").get<std::string>()});
    }
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput((folder / "manifest.json").string() + ": " + error.what());
  }
  if (place.scans.size() < 2) throw InvalidInput(folder.string() + ": a comparison needs two scans or more");
  sort_by_time(place);
  move_near_origin(place);
  return place;
}

}  // namespace raywatch::evaluation
