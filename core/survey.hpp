#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/align.hpp"
#include "core/epoch.hpp"
#include "core/survey_definition.hpp"

namespace raywatch {

/// A scan of an epoch, as a survey names it.
struct SurveyedScan {
  ScanId scan;
  VantageId station;
  SensorId sensor;
  Time captured_at;
  std::size_t points = 0;
  std::string sha256;  ///< of its file
  Pose world_from_sensor;
  RegistrationState registration = RegistrationState::none;
  std::optional<double> residual_m = {};
  PoseUncertainty uncertainty = {};
};

/// An epoch as it takes part in a survey: `about` has one a scan of `scans`.
struct SurveyEpoch {
  const EpochScans& scans;
  std::vector<SurveyedScan> about;
};

/// Where volumes are measured.
struct SurveyZone {
  std::optional<ZoneId> zone = {};  ///< nothing: the whole site
  std::string name;
  Prism prism;
};

/// What M3C2 found in a zone. Its figures are 0 without core points that changed significantly.
struct M3c2Figures {
  std::size_t core_points = 0;
  std::size_t measured = 0;      ///< of them, with a distance and a level of detection
  std::size_t significant = 0;   ///< of those, that changed by more than their level of detection
  double greatest_rise_m = 0.0;  ///< significant distances: towards the sensor
  double greatest_fall_m = 0.0;  ///< and away from it; 0 or less
  double mean_m = 0.0;           ///< of the significant ones
  double mean_lod95_m = 0.0;     ///< of the measured ones
  double greatest_m() const { return greatest_rise_m > -greatest_fall_m ? greatest_rise_m : greatest_fall_m; }
};

/// Tonnes of the volumes.
struct ZoneMasses {
  MassFigure cut, fill, net;
};

/// All figures of one zone, or of all together.
struct ZoneFigures {
  SurveyZone zone;
  ZoneVolumes volumes;
  M3c2Figures m3c2;
  std::optional<ZoneMasses> masses;
};

/// A value with its interval of 95 %, where it has one.
struct FigureValue {
  double value = 0.0;
  std::optional<double> low = {}, high = {};
};
/// Nothing: not measured, because nothing of the zone was seen in both epochs.
std::optional<FigureValue> value_of(const ZoneFigures& figures, SurveyFigure figure);

/// A change between the epochs, with a volume of its own.
struct SurveyChange {
  Change change;
  FootprintVolume volume;
  std::optional<MassFigure> mass;
  std::vector<std::size_t> zones;  ///< places in the survey's zones in which it lies
};

/// A survey: what changed between two epochs, how much, how sure, and what it rests on.
struct SurveyResult {
  SurveyDefinition definition;
  CompareParameters parameters;  ///< of the comparison that made the changes
  std::string program_version;
  std::vector<SurveyedScan> before, after;
  std::vector<ZoneFigures> zones;
  /// Sums over the zones, which should not overlap: what lies in two counts twice. The errors of poses are the same in
  /// all zones, so that their standard errors add up; this is never too narrow.
  ZoneFigures total;
  std::vector<SurveyChange> changes;
  double testable_before = 0.0, testable_after = 0.0;  ///< see `EpochComparison`
  double registration_m = 0.0;                         ///< `reg` of M3C2, from the uncertainties of all poses
  std::vector<std::string> warnings;
  ElevationModel before_model, after_model;              ///< of one layout, over all zones
  std::vector<DifferenceCell> difference;                ///< one a cell
  std::vector<EpochPoints> before_points, after_points;  ///< one a scan: what is said of each of its points
};

/// What a survey is made of. The scans must be registered to each other, and the later epoch be later.
struct SurveyInput {
  SurveyEpoch before, after;
  std::vector<SurveyZone> zones;  ///< none: the whole site
  SurveyDefinition definition;
  CompareParameters parameters;
  std::string program_version;
};

/// Compares two epochs as a whole: changes, elevation models and their difference, volumes by zone, M3C2.
///
/// Deterministic; in the caller's oneTBB arena. Memory: some 100 bytes a point in the zones.
/// @throws InvalidInput as `check_definition`, `compare_epochs`, `layout_over` and `m3c2` do.
SurveyResult survey_between(const SurveyInput& input);

/// The prism that stands for the whole site: where both epochs have all but the outermost thousandth of their returns
/// along each axis, and 1 m below and above. @throws InvalidInput when they have no returns in common.
SurveyZone whole_site(const EpochScans& before, const EpochScans& after);

}  // namespace raywatch
