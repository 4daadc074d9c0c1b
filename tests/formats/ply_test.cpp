#include <doctest/doctest.h>

#include "core/error.hpp"
#include "tests/formats/sample_files.hpp"

using namespace raywatch;
using namespace raywatch::test;

namespace {

std::string ply(const std::string& lines, const std::string& body, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\n" + lines + "end_header\n" + body;
}

const std::string kVertex = "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";

}  // namespace

TEST_CASE("an ascii PLY is read around other elements and properties") {
  const std::string file =
      ply("comment made by hand\nobj_info nothing\nelement material 1\nproperty uchar red\n" + kVertex +
              "property uchar class\nelement face 1\nproperty list uchar int vertex_indices\n",
          "255\n1 2 3 7\n4 5 6 7\n3 0 1 1\n");
  const PointCloud cloud = decode(file)[0].points;
  CHECK(cloud.size() == 2);
  CHECK(cloud[1] == Eigen::Vector3f(4, 5, 6));
}

TEST_CASE("a binary PLY is read in both byte orders") {
  const std::string lines =
      "element vertex 1\nproperty double z\nproperty uchar class\nproperty float x\nproperty "
      "float y\nproperty ushort scalar_Intensity\n";
  const std::string little = bits(3.0) + bits(std::uint8_t{1}) + bits(1.0F) + bits(2.0F) + bits(std::uint16_t{500});
  const std::string big = reversed_bits(3.0) + bits(std::uint8_t{1}) + reversed_bits(1.0F) + reversed_bits(2.0F) +
                          reversed_bits(std::uint16_t{500});
  for (const auto& file : {ply(lines, little, "binary_little_endian"), ply(lines, big, "binary_big_endian")}) {
    const PointCloud cloud = decode(file)[0].points;
    CHECK(cloud[0] == Eigen::Vector3f(1, 2, 3));
    CHECK(cloud.intensity == std::vector<float>{500});
  }
}

TEST_CASE("elements of fixed size before the vertices are stepped over") {
  const std::string body =
      bits(1.0) + bits(2.0) + bits(1.0F) + bits(2.0F) + bits(3.0F) + bits(4.0F) + bits(5.0F) + bits(6.0F);
  const std::string file = ply("element camera 2\nproperty double k\n" + kVertex, body, "binary_little_endian");
  CHECK(decode(file)[0].points[0] == Eigen::Vector3f(1, 2, 3));
}

TEST_CASE("the intensity of a PLY goes by several names") {
  for (const std::string name : {"intensity", "scalar_intensity", "reflectance", "scalar_Intensity"}) {
    CAPTURE(name);
    const std::string file = ply(kVertex + "property float " + name + "\n", "1 2 3 0.5\n4 5 6 0.25\n");
    CHECK(decode(file)[0].points.intensity == std::vector<float>{0.5F, 0.25F});
  }
}

TEST_CASE("a PLY whose lines end with CR LF is read") {
  const std::string file =
      "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\nproperty float x\r\nproperty "
      "float y\r\nproperty float z\r\nend_header\r\n" +
      bits(1.0F) + bits(2.0F) + bits(3.0F);
  CHECK(decode(file)[0].points[0] == Eigen::Vector3f(1, 2, 3));
}

TEST_CASE("a broken PLY is refused with the place") {
  const auto message = [](const std::string& file) { return refusal<InvalidInput>(file); };
  CHECK(contains(message("ply\nformat ascii 1.0\n"), "ends within the PLY header"));
  CHECK(contains(message("ply\nelement vertex 1\nend_header\n1"), "no line 'format'"));
  CHECK(contains(message(ply("", "")), "no element vertex"));
  CHECK(contains(message(ply("property float x\n", "")), "line 3: PLY header: a property before any element"));
  CHECK(contains(message(ply("element vertex many\n", "")), "line 3: 'many'"));
  CHECK(contains(message(ply("element vertex 1\nproperty real x\n", "")), "line 4: PLY header: 'real' is no type"));
  CHECK(contains(message(ply("colour red\n", "")), "'colour' is no keyword"));
  CHECK(contains(message(ply("element vertex 1\nproperty float x\nproperty float y\n", "1 2\n")), "no property z"));
  CHECK(
      contains(message(ply(kVertex + "property list uchar int neighbours\n", "1 2 3 0\n4 5 6 0\n")), "list property"));
  CHECK(contains(message(ply(kVertex, "1 2 3\n4 five 6\n")), "line 9: 'five' is not a number"));
  CHECK(contains(message(ply(kVertex, "1 2 3\n4 5 6 7\n")), "line 9: 4 values instead of 3"));
  CHECK(contains(message(ply(kVertex, "1 2 3333333\n")), "ends before vertex 1 of 2"));
  CHECK(contains(message(ply("element vertex 1\nproperty int x\nproperty int y\nproperty int z\n", "1 2 3\n")),
                 "must be float or double"));
  CHECK(contains(message(ply("element face 1\nproperty list uchar int i\n" + kVertex, "abc", "binary_little_endian")),
                 "has a list"));
  CHECK(contains(message(ply("element camera 9\nproperty double k\n" + kVertex, "abc", "binary_little_endian")),
                 "ends within element 'camera'"));
  CHECK(contains(message("ply\nformat binary_middle_endian 1.0\nend_header\n"), "'binary_middle_endian'"));
}
