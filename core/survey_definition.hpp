#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/elevation_model.hpp"
#include "core/m3c2.hpp"
#include "core/survey_ids.hpp"
#include "core/trend.hpp"

namespace raywatch {

/// Which earlier epoch a survey is compared with.
enum class ReferencePolicy : std::uint8_t {
  fixed,     ///< always the same one
  previous,  ///< the latest before it
  accepted,  ///< the latest before it that was accepted
  days_ago,  ///< that of the same local time, so many days before
};
std::string_view to_string(ReferencePolicy policy);
/// @throws InvalidInput naming the known ones.
ReferencePolicy parse_reference_policy(std::string_view name);

struct SurveyReference {
  ReferencePolicy policy = ReferencePolicy::previous;
  std::optional<EpochId> epoch = {};  ///< with `fixed`
  std::uint32_t days = 0;             ///< with `days_ago`: 1 or more
};

/// What a night must be registered to; one that is worse is refused.
struct RegistrationTolerance {
  double residual_m = 0.05;
  PoseUncertainty uncertainty{.position_m = 0.05, .angle_rad = 0.002};
};

/// A figure of a survey that has a series, thresholds and a place in tables.
enum class SurveyFigure : std::uint8_t {
  cut_m3,
  fill_m3,
  net_m3,          ///< over all cells that both epochs saw
  changed_net_m3,  ///< over the changed cells
  changed_area_m2,
  greatest_rise_m,  ///< along the vertical
  greatest_fall_m,  ///< along the vertical; 0 or less
  mean_change_m,    ///< along the vertical, of the changed cells
  m3c2_greatest_m,  ///< along the local normal: the significant distance of greatest magnitude
  m3c2_mean_m,      ///< along the local normal, of the core points that changed significantly
  seen_share,       ///< of the area, in both epochs; 0..1
};
inline constexpr std::size_t kSurveyFigures = 11;
std::string_view to_string(SurveyFigure figure);
/// @throws InvalidInput naming the known ones.
SurveyFigure parse_survey_figure(std::string_view name);
/// "m3", "m2", "m", or "" of a share.
std::string_view unit_of(SurveyFigure figure);

/// From which magnitude on a figure of a zone is worrying.
struct FigureThresholds {
  SurveyFigure figure = SurveyFigure::net_m3;
  std::optional<ZoneId> zone = {};  ///< not given: the total
  LevelThresholds thresholds = {};
};

/// How a survey is made. Zones, scans and reference are chosen by it, and then given to `survey_between`.
struct SurveyDefinition {
  std::vector<ZoneId> zones = {};  ///< of kind `volume`; none: all of the site, or the whole site when it has none
  double cell_m = 1.0;             ///< of the elevation models
  ElevationParameters elevation = {};
  M3c2Parameters m3c2 = {};  ///< its registration error follows from the poses
  /// Of the core points of M3C2, which are kept to at most `kMostCorePoints` by a wider spacing.
  double core_spacing_m = 1.0;
  SurveyReference reference = {};
  RegistrationTolerance tolerance = {};
  std::optional<double> density_t_per_m3 = {};  ///< of the ground in place; not given: no masses
  /// No ground of the site is steeper: narrows the bounds of ground that was not seen. Not given: nothing is assumed.
  std::optional<double> greatest_slope_deg = {};
  std::vector<FigureThresholds> thresholds = {};
};
inline constexpr std::size_t kMostCorePoints = 50000;

/// @throws InvalidInput naming every field that is out of its range.
void check_definition(const SurveyDefinition& definition);

}  // namespace raywatch
