#include "api/refinement.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>

namespace raywatch {
namespace {

constexpr unsigned kBits = 16;  ///< of a cell's index along each axis
constexpr double kCells = 65536.0;
/// Round 0 adds one point, round r those that first stand apart in cells of 1/2^r; the last those that never do.
constexpr std::size_t kRounds = kBits + 2;

struct Coded {
  std::uint64_t code;
  std::uint32_t place;
};

/// The bits of an index with two free places between each: see Morton, "A computer oriented geodetic data base" (1966).
std::uint64_t spread(std::uint64_t index) {
  index = (index | index << 16U) & 0x0000'0000'FF00'00FFULL;
  index = (index | index << 8U) & 0x0000'00F0'0F00'F00FULL;
  index = (index | index << 4U) & 0x0000'0C30'C30C'30C3ULL;
  return (index | index << 2U) & 0x0000'2492'4924'9249ULL;
}

/// By counting, ten bits at a time from the lowest, each time keeping the order among equals.
void sort_by_code(std::vector<Coded>& coded) {
  constexpr unsigned kDigitBits = 10, kDigits = (3 * kBits + kDigitBits - 1) / kDigitBits;
  constexpr std::size_t kValues = std::size_t{1} << kDigitBits;
  std::vector<Coded> sorted(coded.size());
  for (unsigned digit = 0; digit < kDigits; ++digit) {
    const auto value_of = [&](const Coded& c) { return c.code >> (digit * kDigitBits) & (kValues - 1); };
    std::array<std::size_t, kValues + 1> first{};
    for (const Coded& c : coded) ++first[value_of(c) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const Coded& c : coded) sorted[first[value_of(c)]++] = c;
    coded.swap(sorted);
  }
}

std::vector<Coded> sorted_by_code(const CoordinatePlanes& points) {
  const Quantisation around = quantisation_of(points, {});
  std::vector<Coded> coded;
  if (around.total == 0) return coded;
  coded.reserve(around.total);
  const double edge_m = around.box_m.sizes().maxCoeff();
  const auto cell = [&](double offset_m) {
    return edge_m > 0.0 ? static_cast<std::uint64_t>(std::min(offset_m / edge_m * kCells, kCells - 1.0)) : 0U;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point_m = points[i];
    if (!point_m.allFinite()) continue;
    const Eigen::Vector3d offset_m = point_m - around.box_m.min();
    coded.push_back({spread(cell(offset_m.x())) | spread(cell(offset_m.y())) << 1U | spread(cell(offset_m.z())) << 2U,
                     static_cast<std::uint32_t>(i)});
  }
  sort_by_code(coded);
  return coded;
}

/// The round in which a point is the first of its cell: given by where its code departs from the one before.
std::size_t round_of(std::span<const Coded> sorted, std::size_t i) {
  if (i == 0) return 0;
  const std::uint64_t difference = sorted[i].code ^ sorted[i - 1].code;
  if (difference == 0) return kRounds - 1;
  const auto highest = static_cast<unsigned>(std::bit_width(difference)) - 1U;
  return kBits - highest / 3U;
}

/// 0, 1/2, 1/4, 3/4, ... of the way (van der Corput's sequence): each beginning covers the whole.
void append_spread(std::vector<std::uint32_t>& order, std::span<const std::uint32_t> places) {
  if (places.empty()) return;
  const auto bits = static_cast<unsigned>(std::bit_width(places.size() - 1));
  for (std::size_t k = 0; k < std::size_t{1} << bits; ++k) {
    std::size_t reversed = 0;
    for (unsigned b = 0; b < bits; ++b) reversed |= (k >> b & 1U) << (bits - 1U - b);
    if (reversed < places.size()) order.push_back(places[reversed]);
  }
}

}  // namespace

std::vector<std::uint32_t> refinement_order(const CoordinatePlanes& points) {
  const std::vector<Coded> sorted = sorted_by_code(points);
  std::array<std::vector<std::uint32_t>, kRounds> rounds;
  for (std::size_t i = 0; i < sorted.size(); ++i) rounds[round_of(sorted, i)].push_back(sorted[i].place);
  std::vector<std::uint32_t> order;
  order.reserve(sorted.size());
  for (const auto& places : rounds) append_spread(order, places);
  return order;
}

}  // namespace raywatch
