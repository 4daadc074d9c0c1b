#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "storage/columns.hpp"

/// How values stand in the JSON texts of the store. Reading throws `nlohmann::json::exception` when a value is not what
/// was written.
namespace raywatch::json_values {

using Json = nlohmann::json;

/// Bytes that are not UTF-8, such as a file name in a warning, are replaced.
inline std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

template <class Read>
auto parse(const std::string& text, const Read& read) {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    throw CorruptData(std::string("the store holds a broken JSON text: ") + error.what());
  }
}

/// @{ A number that need not be finite: infinity and NaN are null in JSON.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
inline double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}
/// @}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
template <class T>
std::optional<T> optional_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<T>());
}

template <class SomeId>
Json ids(const std::vector<SomeId>& all) {
  Json list = Json::array();
  for (const SomeId id : all) list.push_back(id.value);
  return list;
}
template <class SomeId>
std::vector<SomeId> ids_of(const Json& json) {
  std::vector<SomeId> all;
  for (const Json& id : json) all.push_back(SomeId{id.get<std::int64_t>()});
  return all;
}
template <class SomeId>
Json id_of(const std::optional<SomeId>& id) {
  return id ? Json(id->value) : Json(nullptr);
}
template <class SomeId>
std::optional<SomeId> optional_id(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(SomeId{json.get<std::int64_t>()});
}

inline Json json_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}
inline Json json_of(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return {pose.position_m.x(), pose.position_m.y(), pose.position_m.z(), q.x(), q.y(), q.z(), q.w()};
}
inline Pose pose_of(const Json& json) {
  const auto n = json.get<std::array<double, 7>>();
  return {Eigen::Quaterniond(n[6], n[3], n[4], n[5]), {n[0], n[1], n[2]}};
}
inline Json json_of(const PoseUncertainty& u) { return {u.position_m, u.angle_rad}; }
inline PoseUncertainty uncertainty_of(const Json& json) { return {json.at(0).get<double>(), json.at(1).get<double>()}; }

}  // namespace raywatch::json_values
