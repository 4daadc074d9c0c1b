#pragma once

// Internal: only .cpp files of api/ include this.
#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/field_errors.hpp"
#include "api/text_values.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace raywatch {

/// A JSON object, read strictly: whoever reads it asks for each member that it knows, then calls `finish`. What is
/// wrong is gathered under the member's full name ("parameters.angle_deg"). A getter gives nothing for a member that is
/// absent, null or wrong; `is_null` tells null, where that means "clear it".
class JsonObject {
 public:
  /// Refers to `value` and `errors`. A value that is no object is an error.
  JsonObject(const nlohmann::json& value, std::string name, FieldErrors& errors);

  std::optional<std::string> text(std::string_view name);
  std::optional<bool> flag(std::string_view name);
  std::optional<double> real(std::string_view name, const RealBounds& bounds = {});
  std::optional<std::int64_t> integer(std::string_view name, const IntegerBounds& bounds = {});
  std::optional<Time> time(std::string_view name);
  std::optional<std::vector<double>> reals(std::string_view name, std::size_t count, const RealBounds& bounds = {});
  std::optional<Eigen::Vector3d> vector3(std::string_view name);
  std::optional<std::vector<std::int64_t>> integers(std::string_view name, const IntegerBounds& bounds = {});
  std::optional<Pose> pose(std::string_view name);  ///< {"position_m", "orientation_xyzw"}
  std::optional<JsonObject> object(std::string_view name);
  /// The member itself, for what has several shapes.
  const nlohmann::json* any(std::string_view name);

  /// What `parse(text)` makes of a text; what it throws stands for the member.
  template <class Parse>
  auto parsed(std::string_view name, Parse parse) -> std::optional<decltype(parse(std::string()))> {
    const std::optional<std::string> value = text(name);
    if (!value) return std::nullopt;
    try {
      return parse(*value);
    } catch (const Error& error) {
      fail(name, error.what());
      return std::nullopt;
    }
  }

  bool is_null(std::string_view name) const;  ///< it is there and null
  void require(std::string_view name);
  void refuse_null(std::string_view name);
  void fail(std::string_view name, std::string_view message) { errors_->add(full_name(name), message); }
  /// Unknown members become errors. Does not throw: the errors do, when the whole input is read.
  void finish();

 private:
  std::string full_name(std::string_view name) const;
  const nlohmann::json* member(std::string_view name);  ///< not null

  const nlohmann::json* value_;
  std::string name_;
  FieldErrors* errors_;
  std::vector<std::string> known_;
};

}  // namespace raywatch
