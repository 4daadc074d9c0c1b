#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/error.hpp"

namespace raywatch {

/// What a number may be; both ends are allowed.
template <class T>
struct Allowed {
  T min = std::numeric_limits<T>::lowest();
  T max = std::numeric_limits<T>::max();
};

/// Reads a TOML file strictly into plain structs: every known key is bound once to a field, which keeps its default
/// when the file does not have the key. Errors are collected, so that a person sees all of them at once:
/// @code
///   ConfigReader reader = ConfigReader::open("raywatch.toml");
///   reader.whole("http.port", config.port, {.min = 1});
///   reader.duration("ingest.future_tolerance_s", config.future_tolerance, {});
///   reader.finish();  // throws when anything was wrong, unknown keys included
/// @endcode
/// A key that holds a quantity ends in its unit. Not thread-safe.
class ConfigReader {
 public:
  /// @throws InvalidInput when the file cannot be read or is no TOML.
  static ConfigReader open(const std::filesystem::path& file);
  /// @param name stands in error messages. @throws InvalidInput when the text is no TOML.
  ConfigReader(std::string_view toml, std::string name);
  ConfigReader(ConfigReader&&) noexcept;
  ~ConfigReader();

  void flag(std::string_view key, bool& value);
  void text(std::string_view key, std::string& value);
  void path(std::string_view key, std::filesystem::path& value);
  void one_of(std::string_view key, std::string& value, std::span<const std::string_view> choices);
  void real(std::string_view key, double& value, Allowed<double> allowed);

  /// A whole number without a unit, or a count.
  template <class Whole>
  requires std::is_unsigned_v<Whole>
  void whole(std::string_view key, Whole& value, Allowed<Whole> allowed) {
    // TOML's whole numbers are signed.
    constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
    std::int64_t read = static_cast<std::int64_t>(value);
    read_whole(key, read,
               {static_cast<std::int64_t>(allowed.min),
                static_cast<std::int64_t>(std::min<std::uint64_t>(allowed.max, kMost))});
    value = static_cast<Whole>(read);
  }

  /// A whole number of mebibytes into a number of bytes. `allowed` is in mebibytes.
  void mebibytes(std::string_view key, std::uint64_t& bytes, Allowed<std::uint64_t> allowed);

  /// A whole number of the duration's own unit.
  template <class Ratio>
  void duration(std::string_view key, std::chrono::duration<std::int64_t, Ratio>& value,
                Allowed<std::int64_t> allowed) {
    std::int64_t count = value.count();
    read_whole(key, count, allowed);
    value = std::chrono::duration<std::int64_t, Ratio>(count);
  }

  /// The tables of an array of tables, "[[key]]", by the names with which their keys are bound: "key[0]", "key[1]", ...
  std::vector<std::string> tables(std::string_view key);
  /// An error unless the file has the key; of a table of such an array.
  void require(std::string_view key);

  /// An error of a key's value that only shows beside others; at its line, when the file has the key.
  void refuse(std::string_view key, const std::string& message);

  /// Ends the reading: keys and tables of the file that no field was bound to are errors too.
  /// @throws InvalidInput when there was any error; its `fields` are the keys with their lines and reasons.
  void finish();

  /// The bound keys that the file does not have, in the order of binding.
  std::vector<std::string> absent_keys() const;
  /// The bound keys to which the file gave another value than the field had, in the order of binding.
  const std::vector<std::string>& changed_keys() const;

 private:
  void read_whole(std::string_view key, std::int64_t& value, Allowed<std::int64_t> allowed);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace raywatch
