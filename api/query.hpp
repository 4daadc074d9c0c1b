#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/field_errors.hpp"
#include "api/text_values.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"

namespace raywatch {

/// From a moment to one that is later; either may be open.
struct TimeRange {
  std::optional<Time> from, to;
};

/// The query of a request, read strictly. An endpoint asks for each parameter that it knows, then calls `finish`, which
/// throws everything that was wrong: bad values, repeated parameters, parameters that nobody asked for.
class Query {
 public:
  /// @param query what stands behind '?', still encoded. '+' means a blank there, as in HTML forms.
  explicit Query(std::string_view query);

  std::optional<std::string> text(std::string_view name);
  std::optional<double> real(std::string_view name, const RealBounds& bounds = {});
  std::optional<std::int64_t> integer(std::string_view name, const IntegerBounds& bounds = {});
  /// RFC 3339. A blank where the offset's '+' stood is taken for that: "…T02:10:00+01:00" is a common way to write it.
  std::optional<Time> time(std::string_view name);
  TimeRange time_range();                                               ///< `from` and `to`
  std::optional<Eigen::Vector3d> vector3(std::string_view name);        ///< "x,y,z"
  std::optional<Eigen::AlignedBox3d> box(std::string_view name);        ///< "x0,y0,z0,x1,y1,z1", each 0 not above its 1
  std::optional<std::vector<std::string>> list(std::string_view name);  ///< "a,b,c", none empty
  PageRequest page();                                                   ///< `limit` and `cursor`

  /// What `parse(text)` makes of the value; what it throws stands for the parameter.
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

  bool has(std::string_view name) const;
  void require(std::string_view name);  ///< an error unless it is there
  void fail(std::string_view name, std::string_view message) { errors_.add(name, message); }
  /// @throws InvalidInput.
  void finish();

 private:
  std::optional<std::vector<double>> reals(std::string_view name, std::size_t count);

  std::vector<std::pair<std::string, std::string>> values_;
  std::vector<std::string> known_;
  FieldErrors errors_;
};

}  // namespace raywatch
