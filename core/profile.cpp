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
      parameters.support_distance_m = 0.08;
      parameters.range_m = 0.10;
      parameters.cluster_distance_m = 0.10;
      parameters.cluster_min_points = 20;
      break;
    case Profile::outdoor:
      parameters.support_distance_m = 0.20;
      parameters.range_m = 0.25;
      parameters.cluster_distance_m = 0.40;
      parameters.cluster_min_points = 12;
      break;
    case Profile::survey:
      parameters.support_distance_m = 0.20;
      parameters.range_m = 0.25;
      parameters.cluster_distance_m = 1.0;
      parameters.cluster_min_points = 40;
      break;
  }
  return parameters;
}

}  // namespace raywatch
