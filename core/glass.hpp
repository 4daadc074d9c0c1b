#pragma once

#include <cstdint>
#include <span>

#include "core/compare.hpp"

namespace raywatch {

/// Whether a cluster may be glass, or polished: flat, and in line with a surface that `asked` shows beside it, but
/// nowhere as obliquely as it would have met the cluster, while the scan itself met that less obliquely. Such a surface
/// returns only rays that meet it nearly upright; that others went through it does not tell that it was not there.
/// @param members points of `view`
bool may_be_glass(const ScanView& view, std::span<const std::uint32_t> members, const ScanView& asked);

}  // namespace raywatch
