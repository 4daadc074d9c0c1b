#pragma once

#include <cstdint>
#include <vector>

#include "storage/formats/quantise.hpp"

namespace raywatch {

/// The places of the finite points, ordered from coarse to fine: each beginning of the list is an even thinning in
/// space of all, and a longer one only adds to it. The cube around the points is halved again and again along each
/// axis; a round adds one point for each occupied cell that has none yet, spread evenly along the curve through the
/// cells. Points in one of the finest cells (1/65536 of the cube's edge) come last. Deterministic; O(n log n).
std::vector<std::uint32_t> refinement_order(const CoordinatePlanes& points);

}  // namespace raywatch
