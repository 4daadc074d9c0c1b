#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace raywatch::evaluation {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// Pixels row by row from the top left.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  Picture(int w, int h)
      : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 255) {}

  /// Fills a square around a pixel; what lies outside of the picture is cut off.
  void fill(int x, int y, int half_size, const Colour& colour);
};

/// @throws StorageError when the file cannot be written.
void write_png(const Picture& picture, const std::filesystem::path& path);

}  // namespace raywatch::evaluation
