#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

#include "core/error.hpp"
#include "storage/formats/decode.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

struct FormatName {
  std::string_view name;
  ScanFormat format;
};

constexpr std::array kNames = {
    FormatName{"pcd", ScanFormat::pcd},  FormatName{"ply", ScanFormat::ply},   FormatName{"las", ScanFormat::las},
    FormatName{"ptx", ScanFormat::ptx},  FormatName{"text", ScanFormat::text}, FormatName{"kitti", ScanFormat::kitti},
    FormatName{"xyz", ScanFormat::text}, FormatName{"csv", ScanFormat::text},  FormatName{"txt", ScanFormat::text},
    FormatName{"asc", ScanFormat::text}, FormatName{"bin", ScanFormat::kitti},
};

constexpr std::string_view kKnownFormats =
    "known are pcd, ply, las (uncompressed), ptx, text (xyz, csv, txt, asc) and kitti (bin)";

/// Whatever shows the format stands in so many bytes.
constexpr std::size_t kBeginning = 4096;

std::optional<ScanFormat> format_named(std::string_view name) {
  const std::string lower = lower_case(name);
  const auto* found = std::ranges::find(kNames, std::string_view(lower), &FormatName::name);
  if (found == kNames.end()) return std::nullopt;
  return found->format;
}

std::string_view ending_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : name.substr(dot + 1);
}

/// A PCD header may begin with comments of any kind.
bool looks_like_pcd(std::string_view text) {
  if (text.starts_with("# .PCD")) return true;
  TextLines lines(text);
  std::vector<std::string_view> words;
  while (lines.next()) {
    split_words(lines.line(), words);
    if (words.empty() || words[0].starts_with('#')) continue;
    return words[0] == "VERSION" && words.size() == 2;
  }
  return false;
}

/// Also "nan" and "inf", and what only looks like a number: the reader says what is wrong with it.
bool is_number(std::string_view word) {
  return !word.empty() &&
         (word.find_first_not_of("0123456789+-.eE") == std::string_view::npos || try_parse_real(word).has_value());
}

/// Two lines of one whole number, four of three numbers, four of four.
bool looks_like_ptx(std::string_view text) {
  TextLines lines(text);
  std::vector<std::string_view> words;
  for (const std::size_t expected : {1, 1, 3, 3, 3, 3, 4, 4, 4, 4}) {
    if (!lines.next()) return false;
    split_words(lines.line(), words);
    if (words.size() != expected || !std::ranges::all_of(words, is_number)) return false;
  }
  return true;
}

/// The first line that is no comment begins with three numbers or names the columns x, y and z.
bool looks_like_table(std::string_view text) {
  TextLines lines(text);
  std::vector<std::string_view> words;
  while (lines.next()) {
    std::string line = lower_case(lines.line());
    if (line.starts_with('#') || line.starts_with("//")) continue;
    std::ranges::replace_if(
        line, [](char c) { return c == ',' || c == ';'; }, ' ');
    split_words(line, words);
    if (words.empty()) continue;
    const auto named = [&](std::string_view name) { return std::ranges::find(words, name) != words.end(); };
    return (words.size() >= 3 && std::all_of(words.begin(), words.begin() + 3, is_number)) ||
           (named("x") && named("y") && named("z"));
  }
  return false;
}

std::optional<ScanFormat> format_of_content(std::string_view text) {
  if (looks_like_pcd(text)) return ScanFormat::pcd;
  if (text.starts_with("ply\n") || text.starts_with("ply\r\n")) return ScanFormat::ply;
  if (text.starts_with("LASF")) return ScanFormat::las;
  if (text.starts_with("RWPB")) {
    throw UnsupportedFormat("this is a point table that raywatch wrote, not a scan; " + std::string(kKnownFormats));
  }
  if (looks_like_ptx(text)) return ScanFormat::ptx;
  if (looks_like_table(text)) return ScanFormat::text;
  return std::nullopt;
}

}  // namespace

ScanFormat detect_scan_format(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view beginning = as_text(bytes.first(std::min(bytes.size(), kBeginning)));
  if (const auto format = format_of_content(beginning)) return *format;
  if (lower_case(ending_of(name)) == "laz") {
    throw UnsupportedFormat("compressed LAS (LAZ) is not read; please decompress it to LAS first");
  }
  if (const auto format = format_named(ending_of(name))) return *format;
  throw UnsupportedFormat("neither the content nor the ending of a name shows a format; " + std::string(kKnownFormats) +
                          ". KITTI shows only in the ending: for a file with another one, or an upload, give "
                          "format=kitti");
}

ScanFormat scan_format_of(const std::filesystem::path& file) {
  std::array<char, kBeginning> beginning;
  std::ifstream in(file, std::ios::binary);
  in.read(beginning.data(), beginning.size());
  if (in.bad() || (in.fail() && !in.eof())) throw StorageError(file.string() + ": cannot be read");
  const std::span read(beginning.data(), static_cast<std::size_t>(in.gcount()));
  return detect_scan_format(std::as_bytes(read), file.filename().string());
}

ScanFormat parse_scan_format(std::string_view name) {
  if (const auto format = format_named(name)) return *format;
  throw UnsupportedFormat(shown(name) + " is no scan format; " + std::string(kKnownFormats));
}

std::string_view to_string(ScanFormat format) { return std::ranges::find(kNames, format, &FormatName::format)->name; }

}  // namespace raywatch
