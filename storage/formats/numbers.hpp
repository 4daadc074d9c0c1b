#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

namespace raywatch {

/// The types of number that scan files hold.
enum class NumberType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t size_of(NumberType type);

/// Calls `use` with a value of the type that `type` names.
template <class Use>
decltype(auto) visit_number(NumberType type, Use&& use) {
  switch (type) {
    case NumberType::i8:
      return use(std::int8_t{});
    case NumberType::u8:
      return use(std::uint8_t{});
    case NumberType::i16:
      return use(std::int16_t{});
    case NumberType::u16:
      return use(std::uint16_t{});
    case NumberType::i32:
      return use(std::int32_t{});
    case NumberType::u32:
      return use(std::uint32_t{});
    case NumberType::i64:
      return use(std::int64_t{});
    case NumberType::u64:
      return use(std::uint64_t{});
    case NumberType::f32:
      return use(float{});
    case NumberType::f64:
      break;
  }
  return use(double{});
}

/// The number at `at`, which need not be aligned. The bits of a NaN are kept.
template <class T, std::endian order = std::endian::little>
T load(const std::byte* at) {
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

/// a * b, unless it does not fit.
inline std::optional<std::uint64_t> checked_product(std::uint64_t a, std::uint64_t b) {
  std::uint64_t product = 0;
  if (__builtin_mul_overflow(a, b, &product)) return std::nullopt;
  return product;
}

}  // namespace raywatch
