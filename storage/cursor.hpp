#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "storage/page.hpp"
#include "storage/sqlite.hpp"

namespace raywatch {

/// A cursor is base64url of the list's name and the sorting key of the last item, so that a list goes on behind that
/// item however many were inserted before it.
std::string encode_cursor(std::string_view list, std::span<const std::int64_t> key);
/// @throws InvalidInput("cursor") when the text is no cursor of `list` with `size` numbers.
std::vector<std::int64_t> decode_cursor(std::string_view cursor, std::string_view list, std::size_t size);

/// The number of items to give. @throws InvalidInput("limit") outside 1..1000.
std::size_t checked_limit(const PageRequest& page);

/// The key behind which the page starts: of its cursor, or `start`.
template <std::size_t N>
std::array<std::int64_t, N> key_before(const PageRequest& page, std::string_view list,
                                       const std::array<std::int64_t, N>& start) {
  if (!page.cursor) return start;
  const std::vector<std::int64_t> numbers = decode_cursor(*page.cursor, list, N);
  std::array<std::int64_t, N> key{};
  std::copy(numbers.begin(), numbers.end(), key.begin());
  return key;
}

/// How many rows to ask for: one more than the page holds tells whether another page follows.
inline std::size_t rows_to_read(const PageRequest& page) { return checked_limit(page) + 1; }

/// Cuts what was read down to a page. `key(item)` gives the item's sorting key.
template <class T, class Key>
Page<T> make_page(std::vector<T> items, const PageRequest& page, std::string_view list, const Key& key) {
  Page<T> result{std::move(items), std::nullopt};
  if (result.items.size() > page.limit) {
    result.items.resize(page.limit);
    const auto last = key(result.items.back());
    result.next = encode_cursor(list, last);
  }
  return result;
}

}  // namespace raywatch
