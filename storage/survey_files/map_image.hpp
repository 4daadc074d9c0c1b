#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/elevation_model.hpp"

namespace raywatch {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A picture, row by row from the top.
struct MapImage {
  std::size_t width = 0, height = 0;
  std::vector<Colour> pixels;
};

/// How far ground rose or fell, in fixed steps, so that maps of different nights can be compared: reds fall, blues rise
/// (ColorBrewer's RdBu, which colour-blind people can tell apart).
struct RampStep {
  double to_m;  ///< rises above the step before and up to this
  Colour colour;
  std::string_view label;
};
std::span<const RampStep> difference_ramp();
inline constexpr Colour kUnchangedColour{222, 222, 218};
inline constexpr Colour kUnseenColour{250, 250, 248};

/// What one or both epochs saw of a cell.
struct SeenColours {
  Colour both{188, 205, 190}, before{230, 159, 0}, after{86, 180, 233}, neither{90, 90, 90};
};

/// Shaded by a light from the north-west, 45 degrees high, and tinted by height. North up, a pixel a cell; of more than
/// `kMostMapPixels` along a side every n-th cell. Cells that were not seen are hatched.
MapImage height_map(const ElevationModel& model);
/// The ramp over the shaded ground of the later epoch, or the earlier one where the later did not see it; grey where
/// nothing surely changed.
MapImage difference_map(const ElevationModel& before, const ElevationModel& after,
                        std::span<const DifferenceCell> difference);
MapImage seen_map(const ElevationModel& before, const ElevationModel& after);
inline constexpr std::size_t kMostMapPixels = 1600;

/// "data:image/png;base64,...". @throws StorageError when libpng cannot write it.
std::string png_data_uri(const MapImage& image);

}  // namespace raywatch
