#include "storage/survey_files/map_image.hpp"

#include <openssl/evp.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace raywatch {
namespace {

constexpr std::array<RampStep, 12> kRamp{{{-5.0, {103, 0, 31}, "falls by more than 5 m"},
                                          {-2.0, {165, 15, 32}, "2 to 5 m"},
                                          {-1.0, {203, 73, 66}, "1 to 2 m"},
                                          {-0.5, {230, 134, 106}, "0.5 to 1 m"},
                                          {-0.2, {247, 182, 153}, "0.2 to 0.5 m"},
                                          {0.0, {252, 219, 200}, "less than 0.2 m"},
                                          {0.2, {209, 229, 240}, "rises by less than 0.2 m"},
                                          {0.5, {157, 203, 225}, "0.2 to 0.5 m"},
                                          {1.0, {103, 169, 207}, "0.5 to 1 m"},
                                          {2.0, {58, 131, 187}, "1 to 2 m"},
                                          {5.0, {33, 95, 157}, "2 to 5 m"},
                                          {std::numeric_limits<double>::infinity(), {5, 48, 97}, "more than 5 m"}}};

Colour scaled(const Colour& colour, double by) {
  Colour result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<std::uint8_t>(std::clamp(std::lround(colour[i] * by), 0L, 255L));
  }
  return result;
}

Colour between(const Colour& a, const Colour& b, double share) {
  Colour result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = static_cast<std::uint8_t>(std::lround(a[i] + share * (b[i] - a[i])));
  return result;
}

/// How bright a slope is in a light from the north-west, 45 degrees high: 1 on level ground.
double shade(const Eigen::Vector2d& slope) {
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  const Eigen::Vector3d light(-0.5, 0.5, std::sqrt(0.5));
  constexpr double kAmbient = 0.35;
  return kAmbient + (1.0 - kAmbient) * std::max(0.0, normal.dot(light)) / light.z();
}

/// A picture of a grid, by a function from cell, column and row (of the picture) to a colour.
template <class Paint>
MapImage painted(const GridLayout& layout, Paint paint) {
  const std::size_t longest = std::max(layout.columns, layout.rows);
  const std::size_t stride = (longest + kMostMapPixels - 1) / kMostMapPixels;
  MapImage image{(layout.columns + stride - 1) / stride, (layout.rows + stride - 1) / stride, {}};
  image.pixels.reserve(image.width * image.height);
  for (std::size_t j = 0; j < image.height; ++j) {
    const std::size_t row = (image.height - 1 - j) * stride;
    for (std::size_t i = 0; i < image.width; ++i)
      image.pixels.push_back(paint(row * layout.columns + i * stride, i, j));
  }
  return image;
}

Colour hatched(const Colour& colour, std::size_t column, std::size_t row) {
  return (column + row) % 4 == 0 ? scaled(colour, 0.86) : colour;
}

/// From green-grey lowlands over sand to near white.
Colour height_tint(double share) {
  constexpr std::array<Colour, 4> kTints{{{126, 150, 128}, {196, 190, 150}, {206, 176, 140}, {240, 236, 230}}};
  const double place = std::clamp(share, 0.0, 1.0) * (kTints.size() - 1);
  const auto step = std::min(static_cast<std::size_t>(place), kTints.size() - 2);
  return between(kTints[step], kTints[step + 1], place - static_cast<double>(step));
}

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // and the zero that OpenSSL writes behind it
  const int size =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

}  // namespace

std::span<const RampStep> difference_ramp() { return kRamp; }

MapImage height_map(const ElevationModel& model) {
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  for (const ElevationCell& cell : model.cells) {
    if (!cell.seen()) continue;
    low_m = std::min(low_m, cell.height_m);
    high_m = std::max(high_m, cell.height_m);
  }
  return painted(model.layout, [&](std::size_t cell, std::size_t column, std::size_t row) {
    const ElevationCell& at = model.cells[cell];
    if (!at.seen()) return hatched(kUnseenColour, column, row);
    const double share = high_m > low_m ? (at.height_m - low_m) / (high_m - low_m) : 0.5;
    return scaled(height_tint(share), shade(at.slope));
  });
}

MapImage difference_map(const ElevationModel& before, const ElevationModel& after,
                        std::span<const DifferenceCell> difference) {
  return painted(after.layout, [&](std::size_t cell, std::size_t column, std::size_t row) {
    const DifferenceCell& at = difference[cell];
    const ElevationCell& ground = after.cells[cell].seen() ? after.cells[cell] : before.cells[cell];
    if (!at.seen()) return hatched(kUnseenColour, column, row);
    // Half of the shade, so that the colour can still be found in the legend.
    const double light = 0.5 + 0.5 * std::min(1.2, shade(ground.slope));
    if (!at.changed()) return scaled(kUnchangedColour, light);
    const auto step = std::ranges::find_if(kRamp, [&](const RampStep& s) { return at.rise_m <= s.to_m; });
    return scaled(step->colour, light);
  });
}

MapImage seen_map(const ElevationModel& before, const ElevationModel& after) {
  constexpr SeenColours kColours;
  return painted(after.layout, [&](std::size_t cell, std::size_t, std::size_t) {
    const bool earlier = before.cells[cell].seen(), later = after.cells[cell].seen();
    if (earlier && later) return scaled(kColours.both, 0.4 + 0.6 * std::min(1.2, shade(after.cells[cell].slope)));
    return earlier ? kColours.before : later ? kColours.after : kColours.neither;
  });
}

std::string png_data_uri(const MapImage& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr) == 0) {
    throw StorageError(std::string("Cannot write a PNG: ") + image.message);
  }
  return "data:image/png;base64," + base64({bytes.data(), size});
}

}  // namespace raywatch
