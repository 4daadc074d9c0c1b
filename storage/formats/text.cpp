#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "storage/formats/decode.hpp"
#include "storage/formats/placement.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

using Cells = std::vector<std::string_view>;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr char kAnyBlanks = ' ';  ///< as a separator: any number of blanks and tabs

/// What the first line that is no comment says about all.
struct TableShape {
  char separator = kAnyBlanks;
  std::size_t columns = 0;
  std::array<std::size_t, 3> xyz = {0, 1, 2};
  std::optional<std::size_t> intensity;
  bool has_header = false;
};

/// A semicolon beats a comma, so that a decimal comma is an error and not a separator.
char separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  if (line.find(',') != std::string_view::npos) return ',';
  return kAnyBlanks;
}

void split(std::string_view line, char separator, Cells& cells) {
  if (separator == kAnyBlanks) {
    split_words(line, cells);
  } else {
    split_cells(line, separator, cells);
  }
}

std::optional<std::size_t> column_named(const Cells& cells, std::string_view name) {
  const auto found = std::ranges::find_if(cells, [&](std::string_view cell) { return lower_case(cell) == name; });
  if (found == cells.end()) return std::nullopt;
  return static_cast<std::size_t>(found - cells.begin());
}

/// Without names the first three columns are x y z, and a fourth and last one is the intensity.
TableShape shape_of(std::string_view line) {
  TableShape shape;
  shape.separator = separator_of(line);
  Cells cells;
  split(line, shape.separator, cells);
  shape.columns = cells.size();
  const auto x = column_named(cells, "x");
  const auto y = column_named(cells, "y");
  const auto z = column_named(cells, "z");
  if (x && y && z) {
    shape.xyz = {*x, *y, *z};
    shape.intensity = column_named(cells, "intensity");
    shape.has_header = true;
  } else if (cells.size() == 4) {
    shape.intensity = 3;
  }
  return shape;
}

bool is_data(std::string_view line) { return !line.empty() && !line.starts_with('#') && !line.starts_with("//"); }

void append_row(PointCloud& cloud, const TableShape& shape, const Cells& cells, std::size_t line,
                const Placement& placement) {
  if (cells.size() != shape.columns || cells.size() < 3) {
    throw InvalidInput(at_line(line) + std::to_string(cells.size()) + " columns instead of " +
                       (shape.columns < 3 ? "at least 3" : std::to_string(shape.columns)));
  }
  const auto value = [&](std::size_t column) { return parse_real(cells[column], line); };
  append_placed(cloud, placement, {value(shape.xyz[0]), value(shape.xyz[1]), value(shape.xyz[2])});
  if (shape.intensity) cloud.intensity.push_back(narrowed(value(*shape.intensity), cloud.size() - 1));
}

PointCloud read_table(std::string_view text, const Placement& placement, const ScanFileLimits& limits) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  PointCloud cloud;
  std::optional<TableShape> shape;
  TextLines lines(text);
  Cells cells;
  while (lines.next()) {
    const std::string_view line = trimmed(lines.line());
    if (!is_data(line)) continue;
    if (!shape) {
      shape = shape_of(line);
      if (shape->has_header) continue;
    }
    if (cloud.size() == limits.max_points) {
      throw TooLarge("the text holds more than " + std::to_string(limits.max_points) + " points, the limit");
    }
    split(line, shape->separator, cells);
    append_row(cloud, *shape, cells, lines.number(), placement);
  }
  if (cloud.empty()) throw InvalidInput("the text holds no points: the scan is empty");
  return cloud;
}

}  // namespace

std::vector<DecodedScan> decode_text(std::span<const std::byte> bytes, const ScanHints& hints,
                                     const ScanFileLimits& limits) {
  const Placement placement = placement_of(hints, Frame::sensor, std::nullopt);
  return single_scan(read_table(as_text(bytes), placement, limits), placement.world_from_sensor);
}

}  // namespace raywatch
