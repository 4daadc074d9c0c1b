#include "tests/evaluate/picture.hpp"

#include <png.h>

#include <algorithm>

#include "core/error.hpp"

namespace raywatch::evaluation {

void Picture::fill(int x, int y, int half_size, const Colour& colour) {
  for (int row = std::max(0, y - half_size); row <= std::min(height - 1, y + half_size); ++row) {
    for (int column = std::max(0, x - half_size); column <= std::min(width - 1, x + half_size); ++column) {
      const std::size_t place =
          3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column));
      std::copy(colour.begin(), colour.end(), rgb.begin() + static_cast<std::ptrdiff_t>(place));
    }
  }
}

void write_png(const Picture& picture, const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, path.c_str(), 0, picture.rgb.data(), 0, nullptr) == 0) {
    throw StorageError("cannot write " + path.string() + ": " + image.message);
  }
}

}  // namespace raywatch::evaluation
