#pragma once

#include <cstddef>

namespace raywatch {

/// Asks the system to back large memory that is about to be filled with huge pages: for millions of points, taking
/// thousands of page faults costs more than reading them. A hint, without effect on what the memory holds.
void prefer_huge_pages(const void* begin, std::size_t bytes);

}  // namespace raywatch
