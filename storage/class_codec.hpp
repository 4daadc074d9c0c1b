#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "storage/payloads.hpp"
#include "storage/sealed_block.hpp"

namespace raywatch {

/// At most so many elements stand in one block of a comparison.
inline constexpr std::size_t kClassBlockElements = 65536;

/// The per-point part of a comparison as sealed blocks: first those of the scan's points, then those of the priors'
/// points.
/// @throws InvalidInput when its vectors have different lengths.
std::vector<std::vector<std::uint8_t>> encode_classes(const ComparisonPoints& points);

/// Appends what one block holds. @throws CorruptData; then `points` is as before.
void decode_class_block(std::span<const std::uint8_t> block, ComparisonPoints& points);

}  // namespace raywatch
