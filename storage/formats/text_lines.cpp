#include "storage/formats/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "core/error.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kBlanks = " \t";

template <class Number>
std::errc parse_whole(std::string_view text, Number& number) {
  const char* first = text.data();
  const char* const last = first + text.size();
  if (text.size() > 1 && *first == '+' && first[1] != '-') ++first;
  const std::from_chars_result result = std::from_chars(first, last, number);
  if (result.ec == std::errc{} && result.ptr != last) return std::errc::invalid_argument;
  return result.ec;
}

template <class Number>
Number required_number(std::string_view text, std::size_t line, const char* what) {
  Number number{};
  const std::errc error = parse_whole(text, number);
  if (error == std::errc{}) return number;
  const bool out_of_range = error == std::errc::result_out_of_range;
  throw InvalidInput(at_line(line) + shown(text) +
                     (out_of_range ? " is out of range" : std::string(" is not ") + what));
}

}  // namespace

bool TextLines::next() {
  if (next_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', next_), text_.size());
  line_ = text_.substr(next_, end - next_);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  next_ = std::min(end + 1, text_.size());
  ++number_;
  return true;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t begin = 0;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (true) {
    while (begin < line.size() && is_blank(line[begin])) ++begin;
    if (begin == line.size()) return;
    std::size_t end = begin;
    while (end < line.size() && !is_blank(line[end])) ++end;
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
}

void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string safe = "'";
  for (const char c : text.substr(0, kLongest)) safe += c >= ' ' && c <= '~' ? c : '?';
  return safe + (text.size() > kLongest ? "...'" : "'");
}

std::string at_line(std::size_t number) { return "line " + std::to_string(number) + ": "; }

std::optional<double> try_parse_real(std::string_view text) {
  double number = 0.0;
  if (parse_whole(text, number) != std::errc{}) return std::nullopt;
  return number;
}

double parse_real(std::string_view text, std::size_t line) { return required_number<double>(text, line, "a number"); }

std::uint64_t parse_count(std::string_view text, std::size_t line) {
  return required_number<std::uint64_t>(text, line, "a whole number that is not negative");
}

}  // namespace raywatch
