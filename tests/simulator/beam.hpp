#pragma once

#include <optional>
#include <span>

#include "tests/simulator/ray_caster.hpp"
#include "tests/simulator/scanner.hpp"

namespace raywatch::simulator {

/// What a beam brings back before noise.
struct Return {
  double range_m;
  StateId state;
};

/// Traces the beam around `axis`: one ray, or five when it diverges.
std::optional<Return> trace_beam(const RayCaster& world, const Ray& axis, const ScannerErrors& errors);

}  // namespace raywatch::simulator
