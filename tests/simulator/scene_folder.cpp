#include "tests/simulator/scene_folder.hpp"

#include <array>
#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "storage/formats/side_car.hpp"
#include "storage/formats/write.hpp"

namespace raywatch::simulator {
namespace {

static_assert(std::endian::native == std::endian::little, "label files are written as they lie in memory");

constexpr std::array<char, 4> kMagic{'R', 'W', 'L', 'B'};
constexpr std::uint32_t kVersion = 1;

template <class Value>
void put(std::ostream& out, const Value& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Value>
Value get(std::istream& in) {
  Value value{};
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  if (!in) throw InvalidInput("the label file ends too early");
  return value;
}

std::ofstream create(const std::filesystem::path& path) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  if (!out) throw StorageError("cannot write " + path.string());
  return out;
}

void close(std::ofstream& out, const std::filesystem::path& path) {
  out.close();
  if (!out) throw StorageError("cannot write " + path.string());
}

nlohmann::json to_json(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

nlohmann::json to_json(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return {{"position_m", to_json(pose.position_m)}, {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

nlohmann::json to_json(const ObjectState& object) {
  return {{"state", object.id},
          {"name", object.name},
          {"kind", object.kind},
          {"box", {{"min_m", to_json(object.box.min())}, {"max_m", to_json(object.box.max())}}},
          {"volume_m3", object.volume_m3}};
}

}  // namespace

void write_labels(std::ostream& out, const std::vector<StateId>& labels) {
  put(out, kMagic);
  put(out, kVersion);
  put(out, static_cast<std::uint64_t>(labels.size()));
  out.write(reinterpret_cast<const char*>(labels.data()),
            static_cast<std::streamsize>(labels.size() * sizeof(StateId)));
}

std::vector<StateId> read_labels(std::istream& in) {
  if (get<std::array<char, 4>>(in) != kMagic || get<std::uint32_t>(in) != kVersion) {
    throw InvalidInput("this is no label file of version 1");
  }
  const auto count = get<std::uint64_t>(in);
  std::vector<StateId> labels;
  for (std::uint64_t i = 0; i < count; ++i) labels.push_back(get<StateId>(in));
  return labels;
}

SceneFolder::SceneFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw StorageError("cannot create " + folder_.string() + ": " + error.message());
}

std::string SceneFolder::add(const std::string& name, const SimulatedScan& scan) {
  const std::string file = name + ".pcd";
  const std::filesystem::path path = folder_ / file;
  std::ofstream points = create(path);
  write_scan_pcd(points, scan.points, scan.reported_world_from_sensor);
  close(points, path);
  ScanHints side_car;
  side_car.frame = Frame::sensor;
  side_car.pose = scan.reported_world_from_sensor;
  side_car.captured_at = scan.captured_at;
  side_car.sensor = scan.sensor;
  write_side_car(path, side_car);

  const std::filesystem::path labels_path = folder_ / (file + ".labels");
  std::ofstream labels = create(labels_path);
  write_labels(labels, scan.labels);
  close(labels, labels_path);
  entries_.push_back({file, scan.sensor, scan.captured_at, scan.true_world_from_sensor, scan.reported_world_from_sensor,
                      scan.points.size(), scan.present});
  return file;
}

void SceneFolder::write_manifest(Family family, const FamilyOptions& options, const Timeline& timeline) const {
  nlohmann::json scans = nlohmann::json::array();
  for (const Entry& entry : entries_) {
    scans.push_back({{"file", entry.file},
                     {"sensor", entry.sensor},
                     {"captured_at", format_rfc3339(entry.captured_at)},
                     {"points", entry.points},
                     {"true_pose", to_json(entry.true_world_from_sensor)},
                     {"reported_pose", to_json(entry.reported_world_from_sensor)},
                     {"present", entry.present}});
  }
  nlohmann::json objects = nlohmann::json::array();
  for (const ObjectState& object : timeline.objects) objects.push_back(to_json(object));
  nlohmann::json earthworks = nlohmann::json::array();
  for (const VolumeChange& change : timeline.earthworks) {
    earthworks.push_back({{"filled_m3", change.filled_m3}, {"cut_m3", change.cut_m3}});
  }
  nlohmann::json manifest{{"family", to_string(family)}, {"seed", options.seed}, {"hard", options.hard},
                          {"density", options.density},  {"scans", scans},       {"objects", objects},
                          {"earthworks", earthworks}};
  if (const TrueGround& ground = timeline.ground; !ground.mean_height_m.empty()) {
    manifest["ground"] = {{"corner_m", {ground.corner_m.x(), ground.corner_m.y()}},
                          {"cell_m", ground.cell_m},
                          {"columns", ground.columns},
                          {"rows", ground.rows},
                          {"mean_height_m", ground.mean_height_m}};
  }
  const std::filesystem::path path = folder_ / "manifest.json";
  std::ofstream out = create(path);
  out << manifest.dump(2) << '\n';
  close(out, path);
}

}  // namespace raywatch::simulator
