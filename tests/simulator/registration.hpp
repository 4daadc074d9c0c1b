#pragma once

#include <cstdint>

#include "core/pose.hpp"

namespace raywatch::simulator {

/// How wrong a reported pose is: standard deviations of each coordinate of the position, and of the rotation about
/// each axis. The whole error is therefore sqrt(3) times larger in the root mean square.
struct RegistrationError {
  double position_sigma_m = 0.0;
  double angle_sigma_rad = 0.0;
};

/// The pose with a random error, which turns it about its own position.
Pose disturbed(const Pose& pose, const RegistrationError& error, std::uint64_t seed);

}  // namespace raywatch::simulator
