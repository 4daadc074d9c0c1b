#pragma once

#include <utility>

#include "storage/page.hpp"

namespace raywatch {

/// All of a list, page by page. @param list (PageRequest) -> Page.
template <class List>
auto all_of_list(const List& list) {
  auto page = list(PageRequest{.limit = 1000, .cursor = {}});
  auto items = std::move(page.items);
  while (page.next) {
    page = list(PageRequest{.limit = 1000, .cursor = page.next});
    items.insert(items.end(), page.items.begin(), page.items.end());
  }
  return items;
}

}  // namespace raywatch
