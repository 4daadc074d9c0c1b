#pragma once

#include <string_view>

#include "core/choose_priors.hpp"
#include "core/compare.hpp"

namespace raywatch {

/// The kind of place that a site is; it decides the defaults of everything that depends on scale.
enum class Profile : std::uint8_t { indoor, outdoor, survey };
std::string_view to_string(Profile profile);
/// @throws InvalidInput naming the known ones.
Profile parse_profile(std::string_view name);

/// The parameters of a profile for a grouping. For `union` these are the published values.
CompareParameters default_parameters(Profile profile, Grouping grouping);

/// Scans of one place that are no farther apart in time than this show the same state of the world.
Duration contemporary_tolerance(Profile profile);

}  // namespace raywatch
