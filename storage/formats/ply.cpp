#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "storage/formats/decode.hpp"
#include "storage/formats/ply_header.hpp"
#include "storage/formats/records.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::string_view kPlace = "element vertex in the PLY header";

/// Numbers of the properties, within their element, that a scan is made of.
struct UsedProperties {
  std::array<std::size_t, 3> xyz{};
  std::optional<std::size_t> intensity;
};

std::size_t find_coordinate(const PlyElement& vertex, std::string_view name) {
  const auto found = std::ranges::find(vertex.properties, name, &PlyProperty::name);
  if (found == vertex.properties.end()) {
    throw InvalidInput("PLY header: element vertex has no property " + std::string(name));
  }
  if (found->type != NumberType::f32 && found->type != NumberType::f64) {
    throw InvalidInput("PLY header: property " + std::string(name) + " must be float or double");
  }
  return static_cast<std::size_t>(found - vertex.properties.begin());
}

/// Writers call it differently.
std::optional<std::size_t> find_intensity(const PlyElement& vertex) {
  for (const std::string_view name : {"intensity", "scalar_intensity", "reflectance"}) {
    const auto found =
        std::ranges::find_if(vertex.properties, [&](const PlyProperty& p) { return lower_case(p.name) == name; });
    if (found != vertex.properties.end()) return static_cast<std::size_t>(found - vertex.properties.begin());
  }
  return std::nullopt;
}

UsedProperties used_properties(const PlyElement& vertex) {
  if (vertex.has_list) throw InvalidInput("PLY header: a list property in element vertex is not read");
  return {{find_coordinate(vertex, "x"), find_coordinate(vertex, "y"), find_coordinate(vertex, "z")},
          find_intensity(vertex)};
}

/// The bytes from the first vertex on. Elements before it are stepped over.
Bytes from_vertices(const PlyHeader& header, const PlyElement& vertex, Bytes data) {
  for (const PlyElement& element : header.elements) {
    if (&element == &vertex) break;
    if (element.has_list && element.count > 0) {
      throw InvalidInput("PLY header: element " + shown(element.name) +
                         " before element vertex has a list, which is not read");
    }
    const auto bytes = checked_product(element.count, element.record_bytes);
    if (!bytes || *bytes > data.size()) {
      throw InvalidInput("the file ends within element " + shown(element.name) + ", before the vertices");
    }
    data = data.subspan(*bytes);
  }
  return data;
}

PointCloud read_binary(const PlyHeader& header, const PlyElement& vertex, Bytes data, const Placement& placement,
                       const ScanFileLimits& limits) {
  const UsedProperties used = used_properties(vertex);
  const Bytes vertices = from_vertices(header, vertex, data);
  check_promise(std::string(kPlace), vertex.count, vertex.record_bytes, vertices.size(), limits);
  const auto view = [&](std::size_t i) {
    const PlyProperty& property = vertex.properties[i];
    return FieldView{vertices.data() + property.offset, vertex.record_bytes, property.type};
  };
  PointFields fields{.x = view(used.xyz[0]), .y = view(used.xyz[1]), .z = view(used.xyz[2]), .intensity = {}};
  if (used.intensity) fields.intensity = view(*used.intensity);
  fields.order = header.data == PlyData::binary_big_endian ? std::endian::big : std::endian::little;
  return read_point_fields(fields, vertex.count, placement);
}

/// Steps to the next line that is not blank. @throws InvalidInput at the end of the file.
void next_record(TextLines& lines, std::vector<std::string_view>& words, const std::string& expected) {
  do {
    if (!lines.next()) throw InvalidInput("the file ends before " + expected + ": it is truncated");
    split_words(lines.line(), words);
  } while (words.empty());
}

PointCloud read_ascii(const PlyHeader& header, const PlyElement& vertex, Bytes data, const Placement& placement,
                      const ScanFileLimits& limits) {
  const UsedProperties used = used_properties(vertex);
  // A number and a separator take two bytes at least; the last separator may be missing.
  check_promise(std::string(kPlace), vertex.count, 2 * vertex.properties.size(), data.size() + 1, limits);
  TextLines lines(as_text(data));
  std::vector<std::string_view> words;
  for (const PlyElement& element : header.elements) {
    if (&element == &vertex) break;
    for (std::uint64_t i = 0; i < element.count; ++i) next_record(lines, words, "element vertex");
  }
  PointCloud cloud;
  cloud.reserve(vertex.count);
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    next_record(lines, words, "vertex " + std::to_string(i) + " of " + std::to_string(vertex.count));
    const std::size_t line = header.lines + lines.number();
    if (words.size() != vertex.properties.size()) {
      throw InvalidInput(at_line(line) + std::to_string(words.size()) + " values instead of " +
                         std::to_string(vertex.properties.size()));
    }
    const auto value = [&](std::size_t property) { return parse_real(words[property], line); };
    append_placed(cloud, placement, {value(used.xyz[0]), value(used.xyz[1]), value(used.xyz[2])});
    if (used.intensity) cloud.intensity.push_back(narrowed(value(*used.intensity), i));
  }
  return cloud;
}

}  // namespace

std::vector<DecodedScan> decode_ply(Bytes bytes, const ScanHints& hints, const ScanFileLimits& limits) {
  const PlyHeader header = parse_ply_header(as_text(bytes));
  const auto vertex = std::ranges::find(header.elements, "vertex", &PlyElement::name);
  if (vertex == header.elements.end()) throw InvalidInput("PLY header: there is no element vertex");
  const Placement placement = placement_of(hints, Frame::sensor, std::nullopt, header.origin_m);
  const Bytes data = bytes.subspan(header.data_offset);
  return single_scan(header.data == PlyData::ascii ? read_ascii(header, *vertex, data, placement, limits)
                                                   : read_binary(header, *vertex, data, placement, limits),
                     placement.world_from_sensor);
}

}  // namespace raywatch
