#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace raywatch {

/// The least number of inserted, deleted, replaced or swapped neighbouring letters that turns `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name that was probably meant by `wrong`: one of `known` that goes on where it ends, or that it goes on from;
/// else the nearest by edit distance, the first of equals; none if even that differs in more than a third of its
/// letters (at least one). Of names with dots the letters behind the last one count.
std::optional<std::string> nearest_name(std::string_view wrong, std::span<const std::string> known);

/// What follows "unknown member": "; did you mean 'sensor'?", or all that are known when none of them is near.
std::string suggestion(std::string_view wrong, std::span<const std::string> known);

}  // namespace raywatch
