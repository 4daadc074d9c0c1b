#include "storage/cursor.hpp"

#include <charconv>

#include "core/error.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

std::string base64url(std::string_view bytes) {
  std::string text;
  unsigned bits = 0;
  int held = 0;
  for (const char byte : bytes) {
    bits = (bits << 8 | static_cast<unsigned char>(byte)) & 0xffff;
    for (held += 8; held >= 6; held -= 6) text += kAlphabet[bits >> (held - 6) & 63];
  }
  if (held > 0) text += kAlphabet[bits << (6 - held) & 63];
  return text;
}

std::optional<std::string> from_base64url(std::string_view text) {
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char character : text) {
    const std::size_t value = kAlphabet.find(character);
    if (value == std::string_view::npos) return std::nullopt;
    bits = (bits << 6 | static_cast<unsigned>(value)) & 0xffff;
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes += static_cast<char>(bits >> held & 0xff);
    }
  }
  return bytes;
}

std::optional<std::vector<std::int64_t>> parse_numbers(std::string_view text) {
  std::vector<std::int64_t> numbers;
  while (!text.empty()) {
    if (text.front() != ' ') return std::nullopt;
    text.remove_prefix(1);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

std::string encode_cursor(std::string_view list, std::span<const std::int64_t> key) {
  std::string text(list);
  for (const std::int64_t number : key) text += ' ' + std::to_string(number);
  return base64url(text);
}

std::vector<std::int64_t> decode_cursor(std::string_view cursor, std::string_view list, std::size_t size) {
  const std::optional<std::string> text = from_base64url(cursor);
  if (text && text->starts_with(list)) {
    std::optional<std::vector<std::int64_t>> key = parse_numbers(std::string_view(*text).substr(list.size()));
    // Only what this program itself wrote is taken.
    if (key && key->size() == size && encode_cursor(list, *key) == cursor) return std::move(*key);
  }
  throw InvalidInput("the cursor is not one that this list gave",
                     {{"cursor", "must be the \"next\" of the page before, unaltered"}});
}

std::size_t checked_limit(const PageRequest& page) {
  constexpr std::size_t kMax = 1000;
  if (page.limit < 1 || page.limit > kMax) {
    throw InvalidInput("the limit is out of range", {{"limit", "must be from 1 to " + std::to_string(kMax)}});
  }
  return page.limit;
}

}  // namespace raywatch
