#include "storage/formats/side_car.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "storage/formats/file_bytes.hpp"
#include "storage/formats/naming_file.hpp"
#include "storage/formats/placement.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 4> kMembers = {"captured_at", "sensor", "frame", "pose"};
constexpr std::array<std::string_view, 2> kPoseMembers = {"position_m", "orientation_xyzw"};

/// A side-car holds a few values; what is larger is something else.
constexpr std::uint64_t kMaxSideCarBytes = 1 << 20;

std::filesystem::path side_car_path(const std::filesystem::path& scan_file) {
  std::filesystem::path path = scan_file;
  path += ".json";
  return path;
}

/// Where something stands, for messages: the side-car's name and the member.
struct Member {
  std::string_view file;
  std::string member;

  [[noreturn]] void refuse(const std::string& message) const {
    throw InvalidInput(std::string(file) + ": " + member + ": " + message, {{member, message}});
  }
};

void check_members(const Json& object, std::span<const std::string_view> known, const Member& parent) {
  for (const auto& item : object.items()) {
    const std::string& key = item.key();
    if (std::ranges::find(known, std::string_view(key)) != known.end()) continue;
    const std::string_view shortened = std::string_view(key).substr(0, 64);
    const std::string name =
        parent.member.empty() ? std::string(shortened) : parent.member + "." + std::string(shortened);
    Member{parent.file, name}.refuse("unknown member" +
                                     suggestion(shortened, std::vector<std::string>(known.begin(), known.end())));
  }
}

std::string text_of(const Json& value, const Member& place) {
  if (!value.is_string()) place.refuse("must be a string");
  return value.get<std::string>();
}

/// JSON in which no object has a member twice: the parser alone would quietly take the last.
Json parse_json(std::string_view text, std::string_view file) {
  std::vector<std::set<std::string>> open_objects;
  const auto check_twice = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == Json::parse_event_t::object_end) open_objects.pop_back();
    if (event == Json::parse_event_t::key && !open_objects.back().insert(value.get<std::string>()).second) {
      Member{file, value.get<std::string>()}.refuse("stands there twice");
    }
    return true;
  };
  try {
    return Json::parse(text, check_twice);
  } catch (const Json::parse_error& error) {
    const std::string_view what = error.what();  // begins with the library's own name for it, in brackets
    throw InvalidInput(std::string(file) + ": malformed JSON: " + std::string(what.substr(what.find("] ") + 2)));
  }
}

/// What `parse` makes of the text; names the place when it refuses.
template <class Parse>
auto parsed(const Member& place, Parse parse, const std::string& text) {
  try {
    return parse(text);
  } catch (const InvalidInput& error) {
    place.refuse(error.what());
  }
}

template <int n>
Eigen::Matrix<double, n, 1> vector_of(const Json& pose, const char* member, std::string_view file) {
  const Member place{file, "pose." + std::string(member)};
  const auto found = pose.find(member);
  if (found == pose.end()) place.refuse("is missing");
  const bool numbers = found->is_array() && found->size() == n &&
                       std::ranges::all_of(*found, [](const Json& number) { return number.is_number(); });
  if (!numbers) place.refuse("must be an array of " + std::to_string(n) + " numbers");
  Eigen::Matrix<double, n, 1> vector;
  for (int i = 0; i < n; ++i) vector[i] = (*found)[static_cast<std::size_t>(i)].get<double>();
  return vector;
}

Pose pose_of(const Json& value, std::string_view file) {
  const Member place{file, "pose"};
  if (!value.is_object()) place.refuse("must be an object");
  check_members(value, kPoseMembers, place);
  const Eigen::Vector3d position_m = vector_of<3>(value, "position_m", file);
  const Eigen::Vector4d orientation_xyzw = vector_of<4>(value, "orientation_xyzw", file);
  return checked_pose_at(std::string(file) + ": pose", position_m, orientation_xyzw);
}

Json pose_json(const Pose& pose) {
  const Eigen::Vector3d& p = pose.position_m;
  const Eigen::Quaterniond& q = pose.orientation;
  return {{"position_m", {p.x(), p.y(), p.z()}}, {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

}  // namespace

ScanHints parse_side_car(std::string_view json, std::string_view name) {
  const Json root = parse_json(json, name);
  if (!root.is_object()) throw InvalidInput(std::string(name) + ": must be a JSON object");
  check_members(root, kMembers, {name, ""});
  ScanHints hints;
  for (const auto& item : root.items()) {
    const Member place{name, item.key()};
    const Json& value = item.value();
    if (place.member == "captured_at") {
      hints.captured_at = parsed(place, parse_rfc3339, text_of(value, place));
    } else if (place.member == "sensor") {
      hints.sensor = text_of(value, place);
    } else if (place.member == "frame") {
      hints.frame = parsed(place, parse_frame, text_of(value, place));
    } else {
      hints.pose = pose_of(value, name);
    }
  }
  return hints;
}

ScanHints read_side_car(const std::filesystem::path& scan_file) {
  const std::filesystem::path path = side_car_path(scan_file);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  const FileBytes file = naming(path, [&] { return FileBytes(path, kMaxSideCarBytes); });
  const std::string_view text{reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
  return parse_side_car(text, path.string());
}

void write_side_car(const std::filesystem::path& scan_file, const ScanHints& hints) {
  nlohmann::ordered_json root = nlohmann::ordered_json::object();
  if (hints.captured_at) root["captured_at"] = format_rfc3339(*hints.captured_at);
  if (hints.sensor) root["sensor"] = *hints.sensor;
  if (hints.frame) root["frame"] = *hints.frame == Frame::sensor ? "sensor" : "world";
  if (hints.pose) root["pose"] = pose_json(*hints.pose);
  std::string text;
  try {
    text = root.dump(2);
  } catch (const nlohmann::ordered_json::type_error&) {
    throw InvalidInput("sensor: the name is not UTF-8", {{"sensor", "is not UTF-8"}});
  }
  const std::filesystem::path path = side_car_path(scan_file);
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text << '\n';
  out.close();
  if (!out) throw StorageError(path.string() + " cannot be written");
}

Pose parse_pose_text(std::string_view text, const char* field) {
  std::vector<std::string_view> cells;
  split_cells(text, ',', cells);
  std::array<double, 7> v{};
  const auto refuse = [&](const std::string& message) { throw InvalidInput(message, {{field, message}}); };
  if (cells.size() != v.size()) {
    refuse("must be seven numbers, x,y,z,qx,qy,qz,qw, but there are " + std::to_string(cells.size()));
  }
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto number = try_parse_real(cells[i]);
    if (!number) refuse(shown(cells[i]) + " is not a number");
    v[i] = *number;
  }
  return checked_pose({v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}, field);
}

}  // namespace raywatch
