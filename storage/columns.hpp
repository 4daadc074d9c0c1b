#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/compare.hpp"
#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/rule.hpp"
#include "core/sensor.hpp"
#include "storage/comparisons.hpp"

namespace raywatch {

class Statement;

// How values stand in single columns.

/// A pose as 7 doubles, little endian: position, then quaternion x, y, z, w.
using PoseBytes = std::array<std::uint8_t, 56>;
PoseBytes pose_bytes(const Pose& pose);
/// @throws CorruptData when the length is wrong.
Pose pose_from_bytes(std::span<const std::uint8_t> bytes);

/// Takes the next three columns of a row: x, y, z.
Eigen::Vector3d take_vector(Statement& row);

/// @{ A box in six columns: least x, y, z, greatest x, y, z; all null for none.
using BoxColumns = std::array<std::optional<double>, 6>;
BoxColumns box_columns(const std::optional<Eigen::AlignedBox3d>& box);
Eigen::AlignedBox3d take_box(Statement& row);
std::optional<Eigen::AlignedBox3d> take_optional_box(Statement& row);
/// @}

/// The enumerator whose `to_string` is `text`. @throws CorruptData when there is none.
template <class Enum>
Enum enum_from_text(std::string_view text, std::initializer_list<Enum> all) {
  for (const Enum value : all) {
    if (to_string(value) == text) return value;
  }
  throw CorruptData("the store holds the unknown name \"" + std::string(text) + "\"");
}

// JSON texts. Reading throws CorruptData when the text is not what was written; writing throws InvalidInput for numbers
// that are not finite.
std::string model_json(const SensorModel& model);
SensorModel model_from_json(const std::string& text);
std::string reference_json(const Reference& reference);
Reference reference_from_json(const std::string& text);
std::string parameters_json(const CompareParameters& parameters);
CompareParameters parameters_from_json(const std::string& text);
std::string counts_json(const std::array<std::uint64_t, kPointClasses>& counts);
std::array<std::uint64_t, kPointClasses> counts_from_json(const std::string& text);
std::string timings_json(const std::map<std::string, double>& timings_ms);
std::map<std::string, double> timings_from_json(const std::string& text);
std::string polygon_json(const std::vector<Eigen::Vector2d>& polygon);
std::vector<Eigen::Vector2d> polygon_from_json(const std::string& text);
/// Without the rule's id and zone, which have columns of their own.
std::string rule_json(const Rule& rule);
Rule rule_from_json(const std::string& text);
std::string texts_json(const std::vector<std::string>& texts);
std::vector<std::string> texts_from_json(const std::string& text);

}  // namespace raywatch
