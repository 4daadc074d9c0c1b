#pragma once

#include "core/compare.hpp"

namespace raywatch {

/// One way of `detect`: the scan's points against the priors, which may be later, too. `prior_points` stay empty.
/// @throws InvalidInput as `detect` does.
Detection detect_points(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters);

}  // namespace raywatch
