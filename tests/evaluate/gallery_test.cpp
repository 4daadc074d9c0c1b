#include "tests/evaluate/gallery.hpp"

#include <doctest/doctest.h>
#include <png.h>

#include "core/error.hpp"
#include "tests/evaluate/plates.hpp"
#include "tests/evaluate/score_case.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch;
using namespace raywatch::evaluation;

namespace {

Picture read_png(const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&image, path.c_str()) != 0);
  image.format = PNG_FORMAT_RGB;
  Picture picture(static_cast<int>(image.width), static_cast<int>(image.height));
  REQUIRE(png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) != 0);
  return picture;
}

std::size_t pixels_of(const Picture& picture, const Colour& colour) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    count += std::equal(colour.begin(), colour.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return count;
}

}  // namespace

TEST_CASE(
    "the gallery has a picture of each kind of error, with what was missed in orange and what was found in green") {
  const Place place{.name = "", .scans = {scan_of({}, 0), scan_of({{5.0, 1.0, kCame}}, 1)}, .states = {}};
  const Case pair{Against::same_pose, 1, {0}};
  const IndexedPlace indexed(place, Profile::indoor);
  const CaseViews views = indexed.views(pair, Grouping::union_);
  const CaseLabels labels = labels_of(indexed, pair);
  Verdicts verdicts{.scan = std::vector<std::uint8_t>(place.scans[1].labels.size(), 0),
                    .priors = {std::vector<std::uint8_t>(place.scans[0].labels.size(), 0)}};
  for (std::size_t i = 0; i < verdicts.scan.size(); ++i) {
    verdicts.scan[i] = place.scans[1].labels[i] == kCame && place.scans[1].points.y_m[i] > 0.0F;
  }
  Gallery gallery;
  gallery.add(views, labels, verdicts, find_errors(views, labels, verdicts));
  const TempDir scratch;
  gallery.write(scratch / "new" / "pictures");
  const Picture picture = read_png(scratch / "new" / "pictures" / "other-missed.png");
  CHECK(pixels_of(picture, {240, 140, 0}) > 1000);
  CHECK(pixels_of(picture, {30, 160, 60}) > 1000);
  CHECK(pixels_of(picture, {215, 30, 40}) == 0);
  const std::filesystem::directory_iterator files(scratch / "new" / "pictures");
  CHECK(std::distance(begin(files), end(files)) == 1);
}

TEST_CASE("a picture that cannot be written is an error that names the file") {
  CHECK_THROWS_AS(write_png(Picture(2, 2), "/nowhere/picture.png"), StorageError);
}
