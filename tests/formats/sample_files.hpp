#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/decode.hpp"

namespace raywatch::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The bytes of a number as they stand in a little-endian file.
template <class T>
std::string bits(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

/// The same in a big-endian file.
template <class T>
std::string reversed_bits(T value) {
  const std::string little = bits(value);
  return {little.rbegin(), little.rend()};
}

/// A PCD header for points of `FIELDS x y z` in F4 and whatever `more` lines replace: lines are given by their names.
struct PcdText {
  std::string fields = "x y z";
  std::string size = "4 4 4";
  std::string type = "F F F";
  std::string count = "1 1 1";
  std::string width = "2";
  std::string height = "1";
  std::string viewpoint = "0 0 0 1 0 0 0";
  std::string points = "2";
  std::string data = "ascii";

  std::string header() const;
};

/// A LAS file with `points` of (X, Y, Z, intensity) in steps of `scale_m` from `origin_m`.
struct LasFile {
  std::uint8_t minor = 2;
  std::uint8_t point_format = 0;
  std::uint16_t extra_bytes = 0;
  std::array<double, 3> scale_m = {0.001, 0.001, 0.001};
  std::array<double, 3> origin_m = {0, 0, 0};
  std::vector<std::array<std::int32_t, 4>> points = {{1000, 2000, 3000, 7}, {-1000, 0, 500, 65535}};

  std::string bytes() const;
};

/// The header of a PTX scan at a position, not turned.
std::string ptx_header(int columns, int rows, const std::array<double, 3>& position_m = {0, 0, 0});

std::vector<DecodedScan> decode(std::string_view bytes, std::string_view name = "", const ScanHints& hints = {},
                                const ScanFileLimits& limits = {});

/// The message of the exception of type `E` that `decode` throws; fails the test when it does not.
template <class E>
std::string refusal(std::string_view bytes, std::string_view name = "", const ScanHints& hints = {},
                    const ScanFileLimits& limits = {}) {
  try {
    decode(bytes, name, hints, limits);
  } catch (const E& error) {
    return error.what();
  }
  return "not refused";
}

bool contains(std::string_view text, std::string_view part);

/// Equal bit for bit, NaN payloads and the sign of zero included.
bool same_bits(std::span<const float> a, std::span<const float> b);
bool same_bits(const PointCloud& a, const PointCloud& b);

/// One valid file of every format and encoding, with a name that tells its format.
struct NamedFile {
  std::string name;
  std::string bytes;
};
std::vector<NamedFile> one_file_of_each_format();

}  // namespace raywatch::test
