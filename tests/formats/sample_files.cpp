#include "tests/formats/sample_files.hpp"

#include <lzf.h>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace raywatch::test {
namespace {

/// A PCD file with its planes compressed; four points are enough for LZF to find something to shorten.
std::string compressed_pcd() {
  PcdText text{.width = "16", .points = "16", .data = "binary_compressed"};
  const std::vector<float> planes(48, 1.5F);
  std::string packed(256, '\0');
  const auto size = static_cast<std::uint32_t>(planes.size() * sizeof(float));
  packed.resize(lzf_compress(planes.data(), size, packed.data(), static_cast<unsigned>(packed.size())));
  return text.header() + bits(static_cast<std::uint32_t>(packed.size())) + bits(size) + packed;
}

std::string binary_points() {
  std::string bytes;
  for (const float value : {1.0F, 2.0F, 3.0F, kNan, 5.0F, 6.0F}) bytes += bits(value);
  return bytes;
}

std::string ply(std::string_view format, const std::string& body) {
  return "ply\nformat " + std::string(format) +
         " 1.0\ncomment a test\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 0\nproperty list uchar int vertex_indices\nend_header\n" +
         body;
}

std::string big_endian_points() {
  std::string bytes;
  for (const float value : {1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F}) bytes += reversed_bits(value);
  return bytes;
}

}  // namespace

std::string PcdText::header() const {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + size + "\nTYPE " +
         type + "\nCOUNT " + count + "\nWIDTH " + width + "\nHEIGHT " + height + "\nVIEWPOINT " + viewpoint +
         "\nPOINTS " + points + "\nDATA " + data + "\n";
}

std::string LasFile::bytes() const {
  constexpr std::array<std::uint16_t, 5> kHeader = {227, 227, 227, 235, 375};
  constexpr std::array<std::uint16_t, 11> kRecord = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  const std::uint16_t header_bytes = kHeader.at(minor);
  const auto record_bytes = static_cast<std::uint16_t>(kRecord.at(point_format & 0x3F) + extra_bytes);
  std::string file(header_bytes, '\0');
  const auto put = [&](std::size_t at, const std::string& value) { file.replace(at, value.size(), value); };
  put(0, "LASF");
  put(24, bits(std::uint8_t{1}) + bits(minor));
  put(94, bits(header_bytes) + bits(std::uint32_t{header_bytes}));
  put(104, bits(point_format) + bits(record_bytes));
  if (minor < 4) {
    put(107, bits(static_cast<std::uint32_t>(points.size())));
  } else {
    put(247, bits(std::uint64_t{points.size()}));
  }
  put(131, bits(scale_m[0]) + bits(scale_m[1]) + bits(scale_m[2]));
  put(155, bits(origin_m[0]) + bits(origin_m[1]) + bits(origin_m[2]));
  for (const auto& [x, y, z, intensity] : points) {
    std::string record = bits(x) + bits(y) + bits(z) + bits(static_cast<std::uint16_t>(intensity));
    record.resize(record_bytes, '\x5A');
    file += record;
  }
  return file;
}

std::string ptx_header(int columns, int rows, const std::array<double, 3>& position_m) {
  std::ostringstream text;
  text.precision(12);
  const auto& [x, y, z] = position_m;
  text << columns << '\n' << rows << '\n' << x << ' ' << y << ' ' << z << "\n1 0 0\n0 1 0\n0 0 1\n";
  text << "1 0 0 0\n0 1 0 0\n0 0 1 0\n" << x << ' ' << y << ' ' << z << " 1\n";
  return text.str();
}

std::vector<DecodedScan> decode(std::string_view bytes, std::string_view name, const ScanHints& hints,
                                const ScanFileLimits& limits) {
  return decode_scan(std::as_bytes(std::span(bytes)), name, hints, limits);
}

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

bool same_bits(std::span<const float> a, std::span<const float> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

bool same_bits(const PointCloud& a, const PointCloud& b) {
  return same_bits(a.x_m, b.x_m) && same_bits(a.y_m, b.y_m) && same_bits(a.z_m, b.z_m) &&
         same_bits(a.intensity, b.intensity) && a.grid == b.grid;
}

std::vector<NamedFile> one_file_of_each_format() {
  PcdText pcd;
  std::vector<NamedFile> files = {{"ascii.pcd", pcd.header() + "1 2 3\nnan 5 6\n"}};
  pcd.data = "binary";
  files.push_back({"binary.pcd", pcd.header() + binary_points()});
  files.push_back({"compressed.pcd", compressed_pcd()});
  files.push_back({"ascii.ply", ply("ascii", "1 2 3\n4 5 6\n")});
  files.push_back({"little.ply", ply("binary_little_endian", binary_points())});
  files.push_back({"big.ply", ply("binary_big_endian", big_endian_points())});
  files.push_back({"v12.las", LasFile{}.bytes()});
  files.push_back({"v14.las", LasFile{.minor = 4, .point_format = 6}.bytes()});
  files.push_back({"two.ptx", ptx_header(1, 2) + "1 2 3 0.5\n0 0 0 0.5\n" + ptx_header(2, 1, {5, 6, 7}) +
                                  "4 5 6 0.25\n7 8 9 0.25\n"});
  files.push_back({"blanks.xyz", "# a comment\n1 2 3\n4 5 6\n"});
  files.push_back({"named.csv", "X,Y,Z,Intensity\n1,2,3,0.5\n4,5,6,0.25\n"});
  files.push_back({"velodyne.bin", bits(1.0F) + bits(2.0F) + bits(3.0F) + bits(0.5F)});
  return files;
}

}  // namespace raywatch::test
