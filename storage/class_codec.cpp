#include "storage/class_codec.hpp"

#include <algorithm>
#include <cstring>

#include "core/error.hpp"

namespace raywatch {
namespace {

// The content of a `point_classes` block of n points, and of a `prior_points` block of n points (elements = n):
//
//   class: n bytes | free: n bytes | supported: n bytes | change_of: n times i32
//   prior: n times u32 | index: n times u32 | class: n bytes | change: n times i32
//
// Integers are little endian. The planes are not shuffled: their runs of equal values compress as they are.

constexpr std::size_t kClassElement_bytes = 3 + sizeof(std::int32_t);
constexpr std::size_t kPriorElement_bytes = 3 * sizeof(std::uint32_t) + 1;

template <class T>
void write(std::vector<std::uint8_t>& out, std::span<const T> values) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
  out.insert(out.end(), bytes, bytes + values.size_bytes());
}

template <class T>
std::vector<T> read(std::span<const std::uint8_t>& in, std::size_t n) {
  std::vector<T> values(n);
  std::memcpy(values.data(), in.data(), n * sizeof(T));
  in = in.subspan(n * sizeof(T));
  return values;
}

template <class T, class Member>
std::vector<Member> plane_of(std::span<const PriorPoint> points, Member T::*member) {
  std::vector<Member> plane;
  plane.reserve(points.size());
  for (const PriorPoint& point : points) plane.push_back(point.*member);
  return plane;
}

std::vector<std::uint8_t> encode_points(const ComparisonPoints& points, std::size_t first, std::size_t n,
                                        BlockSealer& sealer) {
  std::vector<std::uint8_t> content;
  content.reserve(n * kClassElement_bytes);
  write(content, std::span(points.classes).subspan(first, n));
  write(content, std::span(points.free).subspan(first, n));
  write(content, std::span(points.supported).subspan(first, n));
  write(content, std::span(points.change_of).subspan(first, n));
  return sealer.seal({.kind = BlockKind::point_classes, .elements = static_cast<std::uint32_t>(n)}, content);
}

std::vector<std::uint8_t> encode_prior_points(std::span<const PriorPoint> points, BlockSealer& sealer) {
  std::vector<std::uint8_t> content;
  content.reserve(points.size() * kPriorElement_bytes);
  write<std::uint32_t>(content, plane_of(points, &PriorPoint::prior));
  write<std::uint32_t>(content, plane_of(points, &PriorPoint::index));
  write<PointClass>(content, plane_of(points, &PriorPoint::point_class));
  write<std::int32_t>(content, plane_of(points, &PriorPoint::change));
  return sealer.seal({.kind = BlockKind::prior_points, .elements = static_cast<std::uint32_t>(points.size())}, content);
}

void require_classes(const std::vector<PointClass>& classes) {
  const auto known = [](PointClass c) { return static_cast<std::size_t>(c) < kPointClasses; };
  if (!std::all_of(classes.begin(), classes.end(), known)) throw CorruptData("a stored point has an unknown class");
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void decode_points(std::span<const std::uint8_t> content, std::size_t n, ComparisonPoints& points) {
  const auto classes = read<PointClass>(content, n);
  require_classes(classes);
  append(points.classes, classes);
  append(points.free, read<std::uint8_t>(content, n));
  append(points.supported, read<std::uint8_t>(content, n));
  append(points.change_of, read<std::int32_t>(content, n));
}

void decode_prior_points(std::span<const std::uint8_t> content, std::size_t n, ComparisonPoints& points) {
  const auto priors = read<std::uint32_t>(content, n);
  const auto indexes = read<std::uint32_t>(content, n);
  const auto classes = read<PointClass>(content, n);
  const auto changes = read<std::int32_t>(content, n);
  require_classes(classes);
  for (std::size_t i = 0; i < n; ++i) points.prior_points.push_back({priors[i], indexes[i], classes[i], changes[i]});
}

std::size_t checked_elements(const BlockHeader& header) {
  if (header.elements == 0 || header.elements > kClassBlockElements || header.flags != 0) {
    throw CorruptData("a stored block of point classes contradicts itself");
  }
  return header.elements;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> encode_classes(const ComparisonPoints& points) {
  const std::size_t size = points.classes.size();
  if (points.free.size() != size || points.supported.size() != size || points.change_of.size() != size) {
    throw InvalidInput("the planes of a comparison have different lengths");
  }
  BlockSealer sealer;
  std::vector<std::vector<std::uint8_t>> blocks;
  for (std::size_t first = 0; first < size; first += kClassBlockElements) {
    blocks.push_back(encode_points(points, first, std::min(kClassBlockElements, size - first), sealer));
  }
  const std::span<const PriorPoint> prior_points(points.prior_points);
  for (std::size_t first = 0; first < prior_points.size(); first += kClassBlockElements) {
    const std::size_t n = std::min(kClassBlockElements, prior_points.size() - first);
    blocks.push_back(encode_prior_points(prior_points.subspan(first, n), sealer));
  }
  return blocks;
}

void decode_class_block(std::span<const std::uint8_t> block, ComparisonPoints& points) {
  constexpr std::size_t kKindByte = 4;
  const bool of_priors =
      block.size() > kKindByte && block[kKindByte] == static_cast<std::uint8_t>(BlockKind::prior_points);
  const BlockHeader header = open_block(block, of_priors ? BlockKind::prior_points : BlockKind::point_classes);
  const std::size_t n = checked_elements(header);
  if (of_priors) {
    decode_prior_points(block_content(block, n * kPriorElement_bytes), n, points);
  } else {
    decode_points(block_content(block, n * kClassElement_bytes), n, points);
  }
}

}  // namespace raywatch
