#pragma once

#include <cstdint>

#include "core/volume.hpp"
#include "tests/simulator/registration.hpp"

namespace raywatch::evaluation {

/// How a pit is surveyed on two nights: two stations on the wall opposite the bench, with the errors of an instrument
/// and of a registration.
struct VolumeSurvey {
  double cell_m = 2.0;
  std::uint32_t azimuth_steps = 320;
  std::uint32_t elevation_steps = 300;
  double range_noise_m = 0.02;
  GroundSteepness steepness = {};  ///< what the survey states of the ground
  simulator::RegistrationError registration{.position_sigma_m = 0.01, .angle_sigma_rad = 0.002 * 0.017453292519943295};
};

/// A blast or a dig between two nights, surveyed, with what is true.
struct VolumeCase {
  ZoneVolumes volumes;
  double net_m3 = 0.0;        ///< true, over the cells that were seen in both epochs
  double cut_m3 = 0.0;        ///< the same, of the cells that fell
  double fill_m3 = 0.0;       ///< the same, of those that rose
  double whole_net_m3 = 0.0;  ///< true, over the whole zone
};

/// Seeds make different pits, nights, places of the stations and errors. Deterministic.
VolumeCase make_volume_case(std::uint64_t seed, const VolumeSurvey& survey);

}  // namespace raywatch::evaluation
