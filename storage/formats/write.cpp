#include "storage/formats/write.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/error.hpp"
#include "storage/formats/out_buffer.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

constexpr std::array<std::string_view, 5> kFormatNames = {"pcd", "ply", "csv", "bin", "q16"};

/// How the types of column (float, uint8, int32; in the order of the variant) are called in each format.
struct TypeNames {
  std::string_view pcd_size, pcd_type, ply;
};
constexpr std::array<TypeNames, 3> kTypeNames = {{{"4", "F", "float"}, {"1", "U", "uchar"}, {"4", "I", "int"}}};

const TypeNames& type_names(const PointColumn& column) { return kTypeNames[column.values.index()]; }

[[maybe_unused]] std::size_t length_of(const PointColumn& column) {
  return std::visit([](const auto& values) { return values.size(); }, column.values);
}

/// x, y, z and the table's columns, all alike.
std::vector<PointColumn> all_columns(const PointTable& table) {
  std::vector<PointColumn> columns = {{"x", table.x_m}, {"y", table.y_m}, {"z", table.z_m}};
  columns.insert(columns.end(), table.columns.begin(), table.columns.end());
  assert(std::ranges::all_of(columns, [&](const PointColumn& c) { return length_of(c) == table.x_m.size(); }));
  return columns;
}

void write_numbers(OutBuffer& out, std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    out.character(' ');
    out.number(number);
  }
}

void write_origin(OutBuffer& out, std::string_view prefix, const Eigen::Vector3d& origin_m) {
  if (origin_m.isZero(0.0)) return;
  out.text(prefix);
  out.text("origin_m");
  write_numbers(out, {origin_m.x(), origin_m.y(), origin_m.z()});
  out.text("\n");
}

/// The points one after the other, each with all its values.
void write_interleaved(OutBuffer& out, std::span<const PointColumn> columns, std::size_t points) {
  for (std::size_t i = 0; i < points; ++i) {
    for (const PointColumn& column : columns) {
      std::visit([&](const auto& values) { out.bits(values[i]); }, column.values);
    }
  }
}

/// Writes one line of a PCD header that has a word for each column.
template <class Word>
void write_pcd_line(OutBuffer& out, std::string_view name, std::span<const PointColumn> columns, Word&& word) {
  out.text(name);
  for (const PointColumn& column : columns) {
    out.character(' ');
    out.text(word(column));
  }
  out.text("\n");
}

void write_pcd(OutBuffer& out, const PointTable& table, const ShotGrid& shape) {
  const std::vector<PointColumn> columns = all_columns(table);
  out.text("# .PCD v0.7 - Point Cloud Data file format\n");
  write_origin(out, "# ", table.origin_m);
  out.text("VERSION 0.7\n");
  write_pcd_line(out, "FIELDS", columns, [](const PointColumn& c) { return std::string_view(c.name); });
  write_pcd_line(out, "SIZE", columns, [](const PointColumn& c) { return type_names(c).pcd_size; });
  write_pcd_line(out, "TYPE", columns, [](const PointColumn& c) { return type_names(c).pcd_type; });
  write_pcd_line(out, "COUNT", columns, [](const PointColumn&) { return std::string_view("1"); });
  out.text("WIDTH ");
  out.number(shape.columns);
  out.text("\nHEIGHT ");
  out.number(shape.rows);
  out.text("\nVIEWPOINT");
  const Eigen::Vector3d& p = table.viewpoint.position_m;
  const Eigen::Quaterniond& q = table.viewpoint.orientation;
  write_numbers(out, {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()});
  out.text("\nPOINTS ");
  out.number(table.x_m.size());
  out.text("\nDATA binary\n");
  write_interleaved(out, columns, table.x_m.size());
}

void write_ply(OutBuffer& out, const PointTable& table) {
  const std::vector<PointColumn> columns = all_columns(table);
  out.text("ply\nformat binary_little_endian 1.0\n");
  write_origin(out, "comment ", table.origin_m);
  out.text("element vertex ");
  out.number(table.x_m.size());
  for (const PointColumn& column : columns) {
    out.text("\nproperty ");
    out.text(type_names(column).ply);
    out.character(' ');
    out.text(column.name);
  }
  out.text("\nend_header\n");
  write_interleaved(out, columns, table.x_m.size());
}

void write_cell(OutBuffer& out, const PointColumn& column, std::size_t i) {
  if (const auto* ids = std::get_if<std::span<const std::int32_t>>(&column.values)) {
    if ((*ids)[i] != -1) out.number((*ids)[i]);
    return;
  }
  if (const auto* codes = std::get_if<std::span<const std::uint8_t>>(&column.values); codes && !column.labels.empty()) {
    assert((*codes)[i] < column.labels.size());
    out.text(column.labels[(*codes)[i]]);
    return;
  }
  std::visit([&](const auto& values) { out.number(values[i]); }, column.values);
}

/// With an origin the sum is printed, in double; without one the shortest text of the float itself.
void write_coordinates(OutBuffer& out, const PointTable& table, std::size_t i) {
  const std::array<float, 3> point_m = {table.x_m[i], table.y_m[i], table.z_m[i]};
  const bool absolute = !table.origin_m.isZero(0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis > 0) out.character(',');
    if (absolute) {
      out.number(table.origin_m[static_cast<Eigen::Index>(axis)] + static_cast<double>(point_m[axis]));
    } else {
      out.number(point_m[axis]);
    }
  }
}

/// The names of the columns of a CSV, or one row of it: `cell` writes the cell of one column, `coordinates` three.
template <class Cell, class Coordinates>
void write_csv_row(OutBuffer& out, const PointTable& table, Cell&& cell, Coordinates&& coordinates) {
  for (std::size_t c = 0; c < table.leading_columns; ++c) {
    cell(table.columns[c]);
    out.character(',');
  }
  coordinates();
  for (std::size_t c = table.leading_columns; c < table.columns.size(); ++c) {
    out.character(',');
    cell(table.columns[c]);
  }
  out.character('\n');
}

void write_csv(OutBuffer& out, const PointTable& table) {
  assert(table.leading_columns <= table.columns.size());
  write_csv_row(
      out, table, [&](const PointColumn& column) { out.text(column.name); }, [&] { out.text("x,y,z"); });
  for (std::size_t i = 0; i < table.x_m.size(); ++i) {
    write_csv_row(
        out, table, [&](const PointColumn& column) { write_cell(out, column, i); },
        [&] { write_coordinates(out, table, i); });
  }
}

void write_bin(OutBuffer& out, const PointTable& table) {
  constexpr std::uint32_t kVersion = 1;
  out.text("RWPB");
  out.bits(kVersion);
  out.bits(std::uint64_t{table.x_m.size()});
  for (const double origin_m : table.origin_m) out.bits(origin_m);
  out.bits(static_cast<std::uint32_t>(table.columns.size()));
  for (const PointColumn& column : table.columns) {
    out.bits(static_cast<std::uint8_t>(column.values.index()));
    out.bits(static_cast<std::uint8_t>(column.name.size()));
    out.text(column.name);
  }
  for (const PointColumn& column : all_columns(table)) {
    std::visit([&](const auto& values) { out.raw(values.data(), values.size_bytes()); }, column.values);
  }
}

ShotGrid one_row(const PointTable& table) {
  return {.rows = 1, .columns = static_cast<std::uint32_t>(table.x_m.size())};
}

}  // namespace

PointFormat parse_point_format(std::string_view name) {
  const auto* found = std::ranges::find(kFormatNames, name);
  if (found != kFormatNames.end()) return static_cast<PointFormat>(found - kFormatNames.begin());
  const std::string message = shown(name) + " is no format of points; known are pcd, ply, csv, bin and q16";
  throw InvalidInput(message, {{"format", message}});
}

std::string_view media_type(PointFormat format) {
  switch (format) {
    case PointFormat::csv:
      return "text/csv; charset=utf-8";
    case PointFormat::pcd:
    case PointFormat::ply:
    case PointFormat::bin:
    case PointFormat::q16:
      break;
  }
  return "application/octet-stream";
}

void write_points(std::ostream& stream, PointFormat format, const PointTable& table) {
  OutBuffer out(stream);
  switch (format) {
    case PointFormat::pcd:
      write_pcd(out, table, one_row(table));
      break;
    case PointFormat::ply:
      write_ply(out, table);
      break;
    case PointFormat::csv:
      write_csv(out, table);
      break;
    case PointFormat::bin:
      write_bin(out, table);
      break;
    case PointFormat::q16:
      write_quantised(out, table);
      break;
  }
  out.flush();
}

void write_scan_pcd(std::ostream& stream, const PointCloud& points, const Pose& world_from_sensor) {
  PointTable table{.x_m = points.x_m, .y_m = points.y_m, .z_m = points.z_m, .viewpoint = world_from_sensor};
  if (!points.intensity.empty()) table.columns.push_back({"intensity", std::span<const float>(points.intensity)});
  OutBuffer out(stream);
  write_pcd(out, table, points.grid.value_or(one_row(table)));
  out.flush();
}

}  // namespace raywatch
