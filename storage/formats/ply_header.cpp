#include "storage/formats/ply_header.hpp"

#include <map>

#include "core/error.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

using Words = std::vector<std::string_view>;

/// A line of the header, in words.
struct Line {
  std::size_t number = 0;
  Words words;

  [[noreturn]] void refuse(const std::string& message) const {
    throw InvalidInput(at_line(number) + "PLY header: " + message);
  }
  void require_words(std::size_t n, const char* form) const {
    if (words.size() != n) refuse(std::string("expected ") + form);
  }
};

NumberType number_type(const Line& line, std::string_view name) {
  static const std::map<std::string_view, NumberType> kTypes = {
      {"char", NumberType::i8},    {"int8", NumberType::i8},     {"uchar", NumberType::u8},
      {"uint8", NumberType::u8},   {"short", NumberType::i16},   {"int16", NumberType::i16},
      {"ushort", NumberType::u16}, {"uint16", NumberType::u16},  {"int", NumberType::i32},
      {"int32", NumberType::i32},  {"uint", NumberType::u32},    {"uint32", NumberType::u32},
      {"float", NumberType::f32},  {"float32", NumberType::f32}, {"double", NumberType::f64},
      {"float64", NumberType::f64}};
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) line.refuse(shown(name) + " is no type of a property");
  return found->second;
}

PlyData parse_format(const Line& line) {
  line.require_words(3, "format NAME 1.0");
  if (line.words[2] != "1.0") line.refuse("version " + shown(line.words[2]) + " is not 1.0");
  if (line.words[1] == "ascii") return PlyData::ascii;
  if (line.words[1] == "binary_little_endian") return PlyData::binary_little_endian;
  if (line.words[1] == "binary_big_endian") return PlyData::binary_big_endian;
  line.refuse(shown(line.words[1]) + " is none of ascii, binary_little_endian, binary_big_endian");
}

void add_element(PlyHeader& header, const Line& line) {
  line.require_words(3, "element NAME COUNT");
  PlyElement element;
  element.name = line.words[1];
  element.count = parse_count(line.words[2], line.number);
  header.elements.push_back(std::move(element));
}

void add_property(PlyHeader& header, const Line& line) {
  if (header.elements.empty()) line.refuse("a property before any element");
  PlyElement& element = header.elements.back();
  const bool is_list = line.words.size() > 1 && line.words[1] == "list";
  line.require_words(is_list ? 5 : 3, "property TYPE NAME or property list TYPE TYPE NAME");
  if (is_list) number_type(line, line.words[2]);
  PlyProperty property;
  property.name = line.words.back();
  property.type = number_type(line, line.words[line.words.size() - 2]);
  property.is_list = is_list;
  property.offset = element.record_bytes;
  if (!is_list) element.record_bytes += size_of(property.type);
  element.has_list = element.has_list || is_list;
  element.properties.push_back(std::move(property));
}

/// A comment may give what the coordinates are relative to: "comment origin_m x y z".
void parse_comment(PlyHeader& header, const Line& line) {
  if (line.words.size() != 5 || line.words[1] != "origin_m") return;
  for (int axis = 0; axis < 3; ++axis) header.origin_m[axis] = parse_real(line.words[2 + axis], line.number);
  if (!header.origin_m.allFinite()) line.refuse("origin_m is not finite");
}

}  // namespace

PlyHeader parse_ply_header(std::string_view file) {
  PlyHeader header;
  TextLines lines(file);
  if (!lines.next() || lines.line() != "ply") throw InvalidInput("line 1: a PLY file begins with a line 'ply'");
  bool has_format = false;
  Line line;
  while (lines.next()) {
    line.number = lines.number();
    split_words(lines.line(), line.words);
    const std::string_view keyword = line.words.empty() ? std::string_view{} : line.words[0];
    if (keyword == "end_header") {
      if (!has_format) line.refuse("there is no line 'format'");
      header.data_offset = lines.offset();
      header.lines = lines.number();
      return header;
    }
    if (keyword == "format") {
      if (has_format) line.refuse("a second line 'format'");
      header.data = parse_format(line);
      has_format = true;
    } else if (keyword == "element") {
      add_element(header, line);
    } else if (keyword == "property") {
      add_property(header, line);
    } else if (keyword == "comment") {
      parse_comment(header, line);
    } else if (keyword != "obj_info" && !keyword.empty()) {
      line.refuse(shown(keyword) + " is no keyword");
    }
  }
  throw InvalidInput("the file ends within the PLY header, before end_header");
}

}  // namespace raywatch
