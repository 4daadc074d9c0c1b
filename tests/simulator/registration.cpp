#include "tests/simulator/registration.hpp"

#include "tests/simulator/random.hpp"

namespace raywatch::simulator {

Pose disturbed(const Pose& pose, const RegistrationError& error, std::uint64_t seed) {
  RandomSequence random(seed, Purpose::registration);
  const Eigen::Vector3d shift_m = error.position_sigma_m * random.normal_vector();
  const Eigen::Vector3d turn_rad = error.angle_sigma_rad * random.normal_vector();
  const double angle_rad = turn_rad.norm();
  Pose result = pose;
  result.position_m += shift_m;
  if (angle_rad > 0.0) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle_rad, turn_rad / angle_rad));
    result.orientation = (turn * pose.orientation).normalized();
  }
  return result;
}

}  // namespace raywatch::simulator
