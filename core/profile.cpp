#include "core/profile.hpp"

#include "core/names.hpp"

namespace raywatch {
namespace {

constexpr Names<Profile, 3> kProfiles{
    {{Profile::indoor, "indoor"}, {Profile::outdoor, "outdoor"}, {Profile::survey, "survey"}}};

}  // namespace

std::string_view to_string(Profile profile) { return name_of(kProfiles, profile); }
Profile parse_profile(std::string_view name) { return value_of(kProfiles, name, "profile"); }

Duration contemporary_tolerance(Profile profile) {
  using namespace std::chrono_literals;
  switch (profile) {
    case Profile::indoor:
      return 1s;
    case Profile::outdoor:
      return 1s;
    case Profile::survey:
      return 1h;
  }
  return 0s;
}

CompareParameters default_parameters(Profile profile, Grouping grouping) {
  CompareParameters parameters;
  parameters.grouping = grouping;
  parameters.contemporary_tolerance = contemporary_tolerance(profile);
  if (grouping == Grouping::union_) {
    parameters.align = false;
    return parameters;
  }
  switch (profile) {
    case Profile::indoor:
      parameters.range_m = 0.10;
      parameters.support_distance_m = 0.03;
      parameters.growth_distance_m = 0.15;
      parameters.cluster_distance_m = 0.10;
      parameters.cluster_min_points = 5;
      parameters.min_range_m = 0.75;
      break;
    case Profile::outdoor:
      parameters.range_m = 0.15;
      parameters.support_distance_m = 0.06;
      parameters.growth_distance_m = 0.4;
      parameters.foliage_distance_m = 0.8;
      parameters.cluster_distance_m = 0.30;
      parameters.cluster_min_points = 5;
      parameters.min_range_m = 0.75;
      break;
    case Profile::survey:
      parameters.range_m = 0.20;
      parameters.support_distance_m = 0.10;
      parameters.growth_distance_m = 0.6;
      parameters.foliage_distance_m = 1.0;
      parameters.cluster_distance_m = 0.6;
      parameters.cluster_min_points = 9;
      break;
  }
  return parameters;
}

}  // namespace raywatch
