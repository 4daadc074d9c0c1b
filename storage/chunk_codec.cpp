#include "storage/chunk_codec.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/error.hpp"
#include "core/index_kernels.hpp"

namespace raywatch {
namespace {

// The content of a `scan_points` block of n points (elements = n; flag bit 0: with intensity):
//
//   x: n bytes 0 | n bytes 1 | n bytes 2 | n bytes 3   of the little-endian floats, byte 0 the lowest
//   y: the same, z: the same, intensity: the same if there is any
//
// Shuffled this way, sign and exponent, which neighbours share, stand together and compress; the noise of the low
// mantissa bits is kept apart from them.

constexpr std::uint8_t kWithIntensity = 1;

void shuffle(std::span<const float> plane, std::uint8_t* out) {
  const std::size_t n = plane.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(plane[i]);
    out[i] = static_cast<std::uint8_t>(bits);
    out[n + i] = static_cast<std::uint8_t>(bits >> 8);
    out[2 * n + i] = static_cast<std::uint8_t>(bits >> 16);
    out[3 * n + i] = static_cast<std::uint8_t>(bits >> 24);
  }
}

void append_unshuffled(const std::uint8_t* in, std::size_t n, std::vector<float>& plane) {
  const std::size_t start = plane.size();
  plane.resize(start + n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t bits =
        in[i] | std::uint32_t{in[n + i]} << 8 | std::uint32_t{in[2 * n + i]} << 16 | std::uint32_t{in[3 * n + i]} << 24;
    // Not through a float variable: the bits of a signalling NaN must survive.
    std::memcpy(&plane[start + i], &bits, sizeof bits);
  }
}

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kAzimuthBins = 512;
constexpr double kBin_rad = 2.0 * kPi / kAzimuthBins;

std::size_t azimuth_bin(double azimuth_rad) {
  const double bin = std::floor((azimuth_rad + kPi) / kBin_rad);
  return std::min(static_cast<std::size_t>(std::max(bin, 0.0)), kAzimuthBins - 1);
}

/// The first bin behind the longest run of empty ones (circular), where an arc that holds all azimuths starts.
std::size_t arc_start(const std::array<bool, kAzimuthBins>& occupied) {
  std::size_t start = 0, longest = 0, run = 0;
  for (std::size_t i = 0; i < 2 * kAzimuthBins; ++i) {
    if (!occupied[i % kAzimuthBins]) {
      ++run;
      continue;
    }
    if (run > longest) {
      longest = run;
      start = i % kAzimuthBins;
    }
    run = 0;
  }
  return start;
}

struct Interval {
  double min, max;
};

Interval azimuth_arc(const std::vector<double>& azimuths_rad) {
  std::array<bool, kAzimuthBins> occupied{};
  for (const double azimuth_rad : azimuths_rad) occupied[azimuth_bin(azimuth_rad)] = true;
  const std::size_t start = arc_start(occupied);
  Interval arc{4.0 * kPi, -4.0 * kPi};
  for (const double azimuth_rad : azimuths_rad) {
    const double unwrapped_rad = azimuth_bin(azimuth_rad) < start ? azimuth_rad + 2.0 * kPi : azimuth_rad;
    arc.min = std::min(arc.min, unwrapped_rad);
    arc.max = std::max(arc.max, unwrapped_rad);
  }
  return arc;
}

struct SphericalDirection {
  double azimuth_rad, elevation_rad;
};

/// Directions within `kDirectionError_rad` of a chunk's points.
class ChunkDirections {
 public:
  ChunkDirections(std::span<const float> x_m, std::span<const float> y_m, std::span<const float> z_m)
      : planes_{x_m.data(), y_m.data(), z_m.data(), x_m.size()},
        ranges_m_(x_m.size()),
        azimuths_rad_(x_m.size()),
        elevations_rad_(x_m.size()) {
    to_spherical(planes_, ranges_m_.data(), azimuths_rad_.data(), elevations_rad_.data());
  }

  double range_m(std::size_t i) const {
    const double x = planes_.x_m[i], y = planes_.y_m[i], z = planes_.z_m[i];
    return std::sqrt(x * x + y * y + z * z);
  }
  SphericalDirection at(std::size_t i, double range_m) const {
    // Elsewhere squares leave the range of single precision.
    constexpr double kLeast_m = 1e-9, kMost_m = 1e9;
    if (range_m > kLeast_m && range_m < kMost_m) return {azimuths_rad_[i], elevations_rad_[i]};
    const double x = planes_.x_m[i], y = planes_.y_m[i], z = planes_.z_m[i];
    return {std::atan2(y, x), std::atan2(z, std::sqrt(x * x + y * y))};
  }

 private:
  PointPlanes planes_;
  std::vector<float> ranges_m_, azimuths_rad_, elevations_rad_;
};

/// Bounds are compared with angles that were computed another way: this is more than both round.
constexpr double kRounding_rad = 1e-9;

bool arcs_meet(const ChunkBounds& bounds, double azimuth_rad, double half_width_rad) {
  const double low = bounds.azimuth_min_rad - half_width_rad, high = bounds.azimuth_max_rad + half_width_rad;
  if (high - low >= 2.0 * kPi) return true;
  for (const double turn : {-2.0 * kPi, 0.0, 2.0 * kPi}) {
    if (azimuth_rad + turn >= low && azimuth_rad + turn <= high) return true;
  }
  return false;
}

}  // namespace

std::optional<ChunkBounds> chunk_bounds(std::span<const float> x_m, std::span<const float> y_m,
                                        std::span<const float> z_m) {
  const ChunkDirections directions(x_m, y_m, z_m);
  ChunkBounds bounds{.elevation_min_rad = kPi, .elevation_max_rad = -kPi, .range_min_m = HUGE_VAL, .range_max_m = 0.0};
  std::vector<double> azimuths_rad;
  azimuths_rad.reserve(x_m.size());
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    const double range_m = directions.range_m(i);
    if (!std::isfinite(range_m) || range_m == 0.0) continue;
    const SphericalDirection direction = directions.at(i, range_m);
    bounds.elevation_min_rad = std::min(bounds.elevation_min_rad, direction.elevation_rad - kDirectionError_rad);
    bounds.elevation_max_rad = std::max(bounds.elevation_max_rad, direction.elevation_rad + kDirectionError_rad);
    bounds.range_min_m = std::min(bounds.range_min_m, range_m);
    bounds.range_max_m = std::max(bounds.range_max_m, range_m);
    azimuths_rad.push_back(direction.azimuth_rad);
  }
  if (azimuths_rad.empty()) return std::nullopt;
  const Interval arc = azimuth_arc(azimuths_rad);
  bounds.azimuth_min_rad = arc.min - kDirectionError_rad;
  bounds.azimuth_max_rad = arc.max + kDirectionError_rad;
  return bounds;
}

ElevationBand elevation_band(const DirectionCone& cone) {
  const Eigen::Vector3d& u = cone.direction;
  const double elevation_rad = std::atan2(u.z(), std::hypot(u.x(), u.y()));
  const double angle_rad = cone.half_angle_rad + kRounding_rad;
  return {elevation_rad - angle_rad, elevation_rad + angle_rad};
}

bool may_meet(const ChunkBounds& bounds, const DirectionCone& cone) {
  const ElevationBand band = elevation_band(cone);
  if (band.max_rad < bounds.elevation_min_rad || band.min_rad > bounds.elevation_max_rad) return false;
  const Eigen::Vector3d& u = cone.direction;
  const double elevation_rad = 0.5 * (band.min_rad + band.max_rad), angle_rad = 0.5 * (band.max_rad - band.min_rad);
  // A cone that holds a pole meets every azimuth; another reaches asin(sin a / cos e) to both sides.
  const double ratio = std::sin(angle_rad) / std::cos(elevation_rad);
  if (std::abs(elevation_rad) + angle_rad >= kPi / 2.0 || ratio >= 1.0) return true;
  return arcs_meet(bounds, std::atan2(u.y(), u.x()), std::asin(ratio) + kRounding_rad);
}

std::vector<std::uint8_t> encode_chunk(const PointCloud& points, std::size_t first, std::size_t count,
                                       BlockSealer& sealer) {
  const bool with_intensity = !points.intensity.empty();
  std::vector<std::uint8_t> content(count * sizeof(float) * (with_intensity ? 4 : 3));
  std::uint8_t* out = content.data();
  for (const std::vector<float>* plane : {&points.x_m, &points.y_m, &points.z_m, &points.intensity}) {
    if (plane->empty()) continue;
    shuffle(std::span(*plane).subspan(first, count), out);
    out += count * sizeof(float);
  }
  return sealer.seal({.kind = BlockKind::scan_points,
                      .flags = with_intensity ? kWithIntensity : std::uint8_t{0},
                      .elements = static_cast<std::uint32_t>(count)},
                     content);
}

void decode_chunk(std::span<const std::uint8_t> block, bool with_intensity, PointCloud& points) {
  const BlockHeader header = open_block(block, BlockKind::scan_points);
  if (header.elements == 0 || header.elements > kMostChunkPoints ||
      header.flags != (with_intensity ? kWithIntensity : 0)) {
    throw CorruptData("a stored chunk contradicts its scan");
  }
  const std::size_t n = header.elements;
  const std::size_t plane_bytes = n * sizeof(float);
  const std::vector<std::uint8_t> content = block_content(block, plane_bytes * (with_intensity ? 4 : 3));
  append_unshuffled(content.data(), n, points.x_m);
  append_unshuffled(content.data() + plane_bytes, n, points.y_m);
  append_unshuffled(content.data() + 2 * plane_bytes, n, points.z_m);
  if (with_intensity) append_unshuffled(content.data() + 3 * plane_bytes, n, points.intensity);
}

}  // namespace raywatch
