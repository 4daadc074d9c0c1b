#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace raywatch {

/// Where a list goes on: an opaque text that the page before gave.
struct PageRequest {
  std::size_t limit = 100;            ///< 1..1000
  std::optional<std::string> cursor;  ///< @throws InvalidInput("cursor") when it is not one of this list's
};

template <class T>
struct Page {
  std::vector<T> items;
  std::optional<std::string> next;  ///< empty on the last page
};

}  // namespace raywatch
