#include "api/json_object.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"

namespace raywatch {
namespace {

using nlohmann::json;

const json& no_members() {
  static const json empty = json::object();
  return empty;
}

}  // namespace

JsonObject::JsonObject(const json& value, std::string name, FieldErrors& errors)
    : value_(value.is_object() ? &value : &no_members()), name_(std::move(name)), errors_(&errors) {
  if (!value.is_object()) errors.add(name_, "must be a JSON object");
}

std::string JsonObject::full_name(std::string_view name) const {
  return name_.empty() ? std::string(name) : name_ + "." + std::string(name);
}

const json* JsonObject::any(std::string_view name) {
  if (std::ranges::find(known_, name) == known_.end()) known_.emplace_back(name);
  const auto found = value_->find(name);
  return found == value_->end() ? nullptr : &*found;
}

const json* JsonObject::member(std::string_view name) {
  const json* found = any(name);
  return found != nullptr && found->is_null() ? nullptr : found;
}

bool JsonObject::is_null(std::string_view name) const {
  const auto found = value_->find(name);
  return found != value_->end() && found->is_null();
}

void JsonObject::require(std::string_view name) {
  if (any(name) == nullptr) {
    fail(name, "is required");
  } else {
    refuse_null(name);
  }
}

void JsonObject::refuse_null(std::string_view name) {
  if (is_null(name)) fail(name, "must not be null");
}

std::optional<std::string> JsonObject::text(std::string_view name) {
  const json* value = member(name);
  if (value == nullptr) return std::nullopt;
  if (value->is_string()) return value->get<std::string>();
  fail(name, "must be a string");
  return std::nullopt;
}

std::optional<bool> JsonObject::flag(std::string_view name) {
  const json* value = member(name);
  if (value == nullptr) return std::nullopt;
  if (value->is_boolean()) return value->get<bool>();
  fail(name, "must be true or false");
  return std::nullopt;
}

std::optional<double> JsonObject::real(std::string_view name, const RealBounds& bounds) {
  const json* value = member(name);
  if (value == nullptr) return std::nullopt;
  const auto wrong =
      value->is_number() ? complaint(value->get<double>(), bounds) : std::optional<std::string>("must be a number");
  if (wrong) fail(name, *wrong);
  return wrong ? std::nullopt : std::optional<double>(value->get<double>());
}

std::optional<std::int64_t> JsonObject::integer(std::string_view name, const IntegerBounds& bounds) {
  const json* value = member(name);
  if (value == nullptr) return std::nullopt;
  const bool fits =
      value->is_number_integer() && (!value->is_number_unsigned() || value->get<std::uint64_t>() >> 63 == 0);
  const auto wrong = fits ? complaint(value->get<std::int64_t>(), bounds)
                          : complaint_of_no_integer(value->is_number() ? value->get<double>() : 0.0, bounds);
  if (wrong) fail(name, *wrong);
  return wrong ? std::nullopt : std::optional<std::int64_t>(value->get<std::int64_t>());
}

std::optional<Time> JsonObject::time(std::string_view name) {
  return parsed(name, [](const std::string& text) { return parse_rfc3339(text); });
}

std::optional<std::vector<double>> JsonObject::reals(std::string_view name, std::size_t count,
                                                     const RealBounds& bounds) {
  const json* value = member(name);
  if (value == nullptr) return std::nullopt;
  const bool numbers = value->is_array() && value->size() == count &&
                       std::ranges::all_of(*value, [](const json& element) { return element.is_number(); });
  if (!numbers) {
    fail(name, "must be an array of " + std::to_string(count) + " numbers");
    return std::nullopt;
  }
  auto result = value->get<std::vector<double>>();
  for (const double number : result) {
    if (const auto wrong = complaint(number, bounds)) {
      fail(name, *wrong);
      return std::nullopt;
    }
  }
  return result;
}

std::optional<Eigen::Vector3d> JsonObject::vector3(std::string_view name) {
  const auto values = reals(name, 3);
  if (!values) return std::nullopt;
  return Eigen::Vector3d((*values)[0], (*values)[1], (*values)[2]);
}

std::optional<std::vector<std::int64_t>> JsonObject::integers(std::string_view name, const IntegerBounds& bounds) {
  const json* value = member(name);
  if (value == nullptr) return std::nullopt;
  const auto is_fine = [&](const json& element) {
    return element.is_number_integer() && !complaint(element.get<std::int64_t>(), bounds);
  };
  if (value->is_array() && std::ranges::all_of(*value, is_fine)) return value->get<std::vector<std::int64_t>>();
  fail(name, "must be an array of whole numbers from " + std::to_string(bounds.min));
  return std::nullopt;
}

std::optional<JsonObject> JsonObject::object(std::string_view name) {
  const json* value = member(name);
  if (value == nullptr) return std::nullopt;
  return JsonObject(*value, full_name(name), *errors_);
}

std::optional<Pose> JsonObject::pose(std::string_view name) {
  auto members = object(name);
  if (!members) return std::nullopt;
  members->require("position_m");
  members->require("orientation_xyzw");
  const auto position_m = members->vector3("position_m");
  const auto orientation = members->reals("orientation_xyzw", 4);
  members->finish();
  if (!position_m || !orientation) return std::nullopt;
  try {
    return checked_pose(*position_m, Eigen::Map<const Eigen::Vector4d>(orientation->data()), "pose");
  } catch (const Error& error) {
    fail(name, error.what());
    return std::nullopt;
  }
}

void JsonObject::finish() {
  for (const auto& [name, value] : value_->items())
    if (std::ranges::find(known_, name) == known_.end()) fail(name, "unknown member" + suggestion(name, known_));
}

}  // namespace raywatch
