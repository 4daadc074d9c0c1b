#include "storage/formats/pcd_header.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "core/error.hpp"
#include "storage/formats/placement.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

using Words = std::vector<std::string_view>;

/// The entries as they stand: one line each, none twice.
struct Entry {
  std::size_t line = 0;
  Words values;
};
using Entries = std::map<std::string_view, Entry>;

constexpr std::array<std::string_view, 10> kKnownEntries = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                                            "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

[[noreturn]] void refuse(const Entry& entry, const std::string& message) {
  throw InvalidInput(at_line(entry.line) + "PCD header: " + message);
}

const Entry& required(const Entries& entries, std::string_view name) {
  const auto found = entries.find(name);
  if (found == entries.end()) throw InvalidInput("the PCD header has no " + std::string(name));
  return found->second;
}

/// The values of an entry that has one for each field.
const Entry& one_per_field(const Entries& entries, std::string_view name, std::size_t fields) {
  const Entry& entry = required(entries, name);
  if (entry.values.size() != fields) {
    refuse(entry, std::string(name) + " has " + std::to_string(entry.values.size()) + " values for " +
                      std::to_string(fields) + " fields");
  }
  return entry;
}

std::uint64_t single_count(const Entry& entry, std::string_view name) {
  if (entry.values.size() != 1) refuse(entry, std::string(name) + " needs one value");
  return parse_count(entry.values.front(), entry.line);
}

NumberType number_type(const Entry& type, const Entry& size, std::size_t field) {
  const std::string name = std::string(type.values[field]) + std::string(size.values[field]);
  static const std::map<std::string_view, NumberType> kTypes = {
      {"I1", NumberType::i8},  {"U1", NumberType::u8},  {"I2", NumberType::i16}, {"U2", NumberType::u16},
      {"I4", NumberType::i32}, {"U4", NumberType::u32}, {"I8", NumberType::i64}, {"U8", NumberType::u64},
      {"F4", NumberType::f32}, {"F8", NumberType::f64}};
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) {
    refuse(type, "TYPE and SIZE " + shown(name) + " of field " + std::to_string(field + 1) +
                     " is none of I1 I2 I4 I8 U1 U2 U4 U8 F4 F8");
  }
  return found->second;
}

std::vector<PcdField> parse_fields(const Entries& entries) {
  const Entry& names = required(entries, "FIELDS");
  const std::size_t n = names.values.size();
  const Entry& sizes = one_per_field(entries, "SIZE", n);
  const Entry& types = one_per_field(entries, "TYPE", n);
  const Entry* counts = entries.contains("COUNT") ? &one_per_field(entries, "COUNT", n) : nullptr;
  std::vector<PcdField> fields;
  for (std::size_t i = 0; i < n; ++i) {
    PcdField field{.name = std::string(names.values[i]), .type = number_type(types, sizes, i)};
    if (counts != nullptr) field.count = parse_count(counts->values[i], counts->line);
    fields.push_back(std::move(field));
  }
  return fields;
}

/// Sets where each field stands within a point.
void lay_out(PcdHeader& header, const Entry& names) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 32;
  for (PcdField& field : header.fields) {
    const auto bytes = checked_product(field.count, size_of(field.type));
    if (!bytes || *bytes > kMost || header.point_bytes + *bytes > kMost) {
      refuse(names, "a point of more than 2^32 bytes: COUNT of " + shown(field.name));
    }
    field.offset = header.point_bytes;
    field.column = header.point_columns;
    header.point_bytes += *bytes;
    header.point_columns += field.count;
  }
}

void parse_extent(PcdHeader& header, const Entries& entries) {
  const Entry& width = required(entries, "WIDTH");
  header.width = single_count(width, "WIDTH");
  if (const auto height = entries.find("HEIGHT"); height != entries.end()) {
    header.height = single_count(height->second, "HEIGHT");
  }
  const auto cells = checked_product(header.width, header.height);
  if (!cells) refuse(width, "WIDTH times HEIGHT is more than 2^64");
  header.points = *cells;
  if (const auto points = entries.find("POINTS"); points != entries.end()) {
    if (single_count(points->second, "POINTS") != *cells) {
      refuse(points->second, "POINTS is not WIDTH times HEIGHT, which is " + std::to_string(*cells));
    }
  }
}

/// VIEWPOINT is written tx ty tz qw qx qy qz.
std::optional<Pose> parse_viewpoint(const Entry& entry) {
  if (entry.values.size() != 7) refuse(entry, "VIEWPOINT needs seven values: tx ty tz qw qx qy qz");
  std::array<double, 7> v{};
  std::ranges::transform(entry.values, v.begin(), [&](std::string_view word) { return parse_real(word, entry.line); });
  if (v == std::array<double, 7>{0, 0, 0, 1, 0, 0, 0}) return std::nullopt;
  return checked_pose_at(at_line(entry.line) + "VIEWPOINT", {v[0], v[1], v[2]}, {v[4], v[5], v[6], v[3]});
}

PcdData parse_data(const Entry& entry) {
  if (entry.values.size() == 1) {
    if (entry.values[0] == "ascii") return PcdData::ascii;
    if (entry.values[0] == "binary") return PcdData::binary;
    if (entry.values[0] == "binary_compressed") return PcdData::binary_compressed;
  }
  refuse(entry, "DATA is none of ascii, binary, binary_compressed");
}

/// A comment may give what the coordinates are relative to: "# origin_m x y z".
void parse_comment(PcdHeader& header, std::span<const std::string_view> words, std::size_t line) {
  if (words.size() != 5 || words[0] != "#" || words[1] != "origin_m") return;
  for (int axis = 0; axis < 3; ++axis) header.origin_m[axis] = parse_real(words[2 + axis], line);
  if (!header.origin_m.allFinite()) throw InvalidInput(at_line(line) + "origin_m is not finite");
}

/// Collects the lines up to and with DATA.
Entries collect_entries(std::string_view file, PcdHeader& header) {
  Entries entries;
  TextLines lines(file);
  Words words;
  while (!entries.contains("DATA")) {
    if (!lines.next()) throw InvalidInput("the file ends within the PCD header, before DATA");
    split_words(lines.line(), words);
    if (words.empty()) continue;
    if (words[0].starts_with('#')) {
      parse_comment(header, words, lines.number());
      continue;
    }
    const std::string_view name = words[0] == "COLUMNS" ? "FIELDS" : words[0];  // as version 0.5 calls them
    if (std::ranges::find(kKnownEntries, name) == kKnownEntries.end()) {
      throw InvalidInput(at_line(lines.number()) + shown(name) + " is no entry of a PCD header");
    }
    const Entry entry{lines.number(), Words(words.begin() + 1, words.end())};
    if (!entries.emplace(name, entry).second) refuse(entry, std::string(name) + " stands there twice");
  }
  header.data_offset = lines.offset();
  header.lines = lines.number();
  return entries;
}

}  // namespace

PcdHeader parse_pcd_header(std::string_view file) {
  PcdHeader header;
  const Entries entries = collect_entries(file, header);
  header.fields = parse_fields(entries);
  lay_out(header, required(entries, "FIELDS"));
  parse_extent(header, entries);
  if (const auto viewpoint = entries.find("VIEWPOINT"); viewpoint != entries.end()) {
    header.viewpoint = parse_viewpoint(viewpoint->second);
  }
  header.data = parse_data(required(entries, "DATA"));
  return header;
}

}  // namespace raywatch
