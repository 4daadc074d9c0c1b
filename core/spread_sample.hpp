#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace raywatch {

/// The `k`-th of a sample of `n` places: spread evenly however many are taken, and without a period that the order of a
/// scan's shots could meet, as every n/100-th place would meet the rings of a scan with 100 shots a ring.
/// Steps of the golden ratio: H. Weyl, "Über die Gleichverteilung von Zahlen mod. Eins", Math. Ann. 77 (1916).
inline std::size_t spread_place(std::size_t k, std::size_t n) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double turns = static_cast<double>(k) * kGoldenRatio;
  return static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(n));
}

/// Every so manyth of the values, from the first on, so that there are at most `most`.
template <class T>
std::vector<T> thinned(std::span<const T> values, std::size_t most) {
  const std::size_t step = values.empty() ? 1 : (values.size() - 1) / most + 1;
  std::vector<T> chosen;
  for (std::size_t k = 0; k < values.size(); k += step) chosen.push_back(values[k]);
  return chosen;
}

}  // namespace raywatch
