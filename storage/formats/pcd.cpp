#include <lzf.h>

#include <algorithm>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "storage/formats/decode.hpp"
#include "storage/formats/pcd_header.hpp"
#include "storage/formats/records.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

using Bytes = std::span<const std::byte>;

/// The fields that a scan is made of; `intensity` is optional in a file.
struct UsedFields {
  const PcdField* x = nullptr;
  const PcdField* y = nullptr;
  const PcdField* z = nullptr;
  const PcdField* intensity = nullptr;
};

const PcdField* find_field(const PcdHeader& header, std::string_view name) {
  const PcdField* found = nullptr;
  for (const PcdField& field : header.fields) {
    if (field.name != name) continue;
    if (found != nullptr) throw InvalidInput("PCD header: FIELDS names " + std::string(name) + " twice");
    if (field.count != 1) throw InvalidInput("PCD header: COUNT of " + std::string(name) + " is not 1");
    found = &field;
  }
  return found;
}

const PcdField* find_coordinate(const PcdHeader& header, std::string_view name) {
  const PcdField* field = find_field(header, name);
  if (field == nullptr) throw InvalidInput("PCD header: FIELDS has no " + std::string(name));
  if (field->type != NumberType::f32 && field->type != NumberType::f64) {
    throw InvalidInput("PCD header: " + std::string(name) + " must be of TYPE F and SIZE 4 or 8");
  }
  return field;
}

UsedFields used_fields(const PcdHeader& header) {
  return {find_coordinate(header, "x"), find_coordinate(header, "y"), find_coordinate(header, "z"),
          find_field(header, "intensity")};
}

/// Writers that map the file may leave zeros behind the points; anything else there contradicts the header.
void check_nothing_follows(Bytes rest) {
  if (std::ranges::any_of(rest, [](std::byte b) { return b != std::byte{0}; })) {
    throw InvalidInput(std::to_string(rest.size()) + " bytes follow the points that the PCD header promises");
  }
}

/// Views of fields that stand point after point.
PointFields interleaved(const PcdHeader& header, const UsedFields& used, const std::byte* data) {
  const auto view = [&](const PcdField& field) {
    return FieldView{data + field.offset, header.point_bytes, field.type};
  };
  return {view(*used.x), view(*used.y), view(*used.z),
          used.intensity ? std::optional(view(*used.intensity)) : std::nullopt};
}

/// Views of fields that stand plane after plane, as they do once decompressed.
PointFields planar(const PcdHeader& header, const UsedFields& used, const std::byte* data) {
  const auto view = [&](const PcdField& field) {
    return FieldView{data + field.offset * header.points, size_of(field.type), field.type};
  };
  return {view(*used.x), view(*used.y), view(*used.z),
          used.intensity ? std::optional(view(*used.intensity)) : std::nullopt};
}

PointCloud read_binary(const PcdHeader& header, Bytes data, const Placement& placement, const ScanFileLimits& limits) {
  const UsedFields used = used_fields(header);
  check_promise("the PCD header", header.points, header.point_bytes, data.size(), limits);
  check_nothing_follows(data.subspan(header.points * header.point_bytes));
  return read_point_fields(interleaved(header, used, data.data()), header.points, placement);
}

/// What the planes take once decompressed, checked against the header, the limit, and the most that LZF can reach: a
/// back reference of 3 bytes stands for up to 264.
std::uint32_t checked_planes_size(const PcdHeader& header, std::uint32_t packed, std::uint32_t unpacked,
                                  const ScanFileLimits& limits) {
  constexpr std::uint64_t kMostPerByte = 264 / 3;
  check_promise("the PCD header", header.points, header.point_bytes, unpacked, limits);
  if (header.points * header.point_bytes != unpacked) {
    throw InvalidInput("the compressed data claims " + std::to_string(unpacked) + " bytes for points of " +
                       std::to_string(header.points * header.point_bytes) + " bytes");
  }
  if (unpacked > kMostPerByte * packed) {
    throw InvalidInput("the compressed data has " + std::to_string(packed) + " bytes, which cannot hold " +
                       std::to_string(unpacked) + " bytes: the file is truncated or its header is wrong");
  }
  if (unpacked > limits.max_bytes) throw TooLarge("the compressed data unpacks to more bytes than the limit");
  return unpacked;
}

/// Compressed data: u32 packed size, u32 unpacked size, then the LZF stream of all fields plane by plane.
PointCloud read_compressed(const PcdHeader& header, Bytes data, const Placement& placement,
                           const ScanFileLimits& limits) {
  constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
  const UsedFields used = used_fields(header);
  if (data.size() < kSizes) throw InvalidInput("the file ends before the sizes of its compressed data");
  const auto packed = load<std::uint32_t>(data.data());
  const auto stream = data.subspan(kSizes);
  if (packed > stream.size()) {
    throw InvalidInput("the compressed data should have " + std::to_string(packed) + " bytes, but only " +
                       std::to_string(stream.size()) + " follow: the file is truncated");
  }
  check_nothing_follows(stream.subspan(packed));
  const std::uint32_t size =
      checked_planes_size(header, packed, load<std::uint32_t>(data.data() + sizeof(packed)), limits);
  const auto planes = std::make_unique_for_overwrite<std::byte[]>(size);
  if (lzf_decompress(stream.data(), packed, planes.get(), size) != size) {
    throw InvalidInput("the compressed data of the PCD file is broken");
  }
  return read_point_fields(planar(header, used, planes.get()), header.points, placement);
}

PointCloud read_ascii(const PcdHeader& header, Bytes data, const Placement& placement, const ScanFileLimits& limits) {
  const UsedFields used = used_fields(header);
  // A number and a separator take two bytes at least; the last separator may be missing.
  check_promise("the PCD header", header.points, 2 * header.point_columns, data.size() + 1, limits);
  PointCloud cloud;
  cloud.reserve(header.points);
  TextLines lines(as_text(data));
  std::vector<std::string_view> words;
  while (lines.next()) {
    const std::size_t line = header.lines + lines.number();
    split_words(lines.line(), words);
    if (words.empty()) continue;
    if (cloud.size() == header.points) throw InvalidInput(at_line(line) + "more points than the PCD header promises");
    if (words.size() != header.point_columns) {
      throw InvalidInput(at_line(line) + std::to_string(words.size()) + " values instead of " +
                         std::to_string(header.point_columns));
    }
    const auto value = [&](const PcdField& field) { return parse_real(words[field.column], line); };
    append_placed(cloud, placement, {value(*used.x), value(*used.y), value(*used.z)});
    if (used.intensity) cloud.intensity.push_back(narrowed(value(*used.intensity), cloud.size() - 1));
  }
  if (cloud.size() != header.points) {
    throw InvalidInput("the PCD header promises " + std::to_string(header.points) +
                       " points, but the file ends after " + std::to_string(cloud.size()) +
                       ": it is truncated or its header is wrong");
  }
  return cloud;
}

PointCloud read_points(const PcdHeader& header, Bytes data, const Placement& placement, const ScanFileLimits& limits) {
  switch (header.data) {
    case PcdData::ascii:
      return read_ascii(header, data, placement, limits);
    case PcdData::binary:
      return read_binary(header, data, placement, limits);
    case PcdData::binary_compressed:
      break;
  }
  return read_compressed(header, data, placement, limits);
}

std::optional<ShotGrid> shot_grid(const PcdHeader& header) {
  if (header.height <= 1) return std::nullopt;
  return ShotGrid{.rows = static_cast<std::uint32_t>(header.height),
                  .columns = static_cast<std::uint32_t>(header.width)};
}

}  // namespace

std::vector<DecodedScan> decode_pcd(Bytes bytes, const ScanHints& hints, const ScanFileLimits& limits) {
  const PcdHeader header = parse_pcd_header(as_text(bytes));
  const Placement placement = placement_of(hints, Frame::sensor, header.viewpoint, header.origin_m);
  PointCloud points = read_points(header, bytes.subspan(header.data_offset), placement, limits);
  points.grid = shot_grid(header);
  return single_scan(std::move(points), placement.world_from_sensor);
}

}  // namespace raywatch
