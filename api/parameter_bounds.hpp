#pragma once

#include "api/text_values.hpp"

namespace raywatch {

/// @{ What the parameters of a comparison may be, over HTTP and on the command line.
inline constexpr RealBounds kAngleBounds_deg{.min = 0.0, .max = 90.0, .exclusive_min = true};
inline constexpr RealBounds kThresholdBounds_m{.min = 0.0, .max = 1000.0};
inline constexpr RealBounds kRangeBounds_m{.min = 0.0, .max = 1e9};
inline constexpr RealBounds kContemporaryBounds_s{.min = 0.0, .max = 1e9};
inline constexpr IntegerBounds kMinPointsBounds{.min = 0, .max = 1'000'000'000};
/// @}

}  // namespace raywatch
