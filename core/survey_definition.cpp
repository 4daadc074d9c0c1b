#include "core/survey_definition.hpp"

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/names.hpp"

namespace raywatch {
namespace {

constexpr Names<ReferencePolicy, 4> kPolicies{{{ReferencePolicy::fixed, "fixed"},
                                               {ReferencePolicy::previous, "previous"},
                                               {ReferencePolicy::accepted, "accepted"},
                                               {ReferencePolicy::days_ago, "days_ago"}}};

constexpr Names<SurveyFigure, kSurveyFigures> kFigures{{{SurveyFigure::cut_m3, "cut_m3"},
                                                        {SurveyFigure::fill_m3, "fill_m3"},
                                                        {SurveyFigure::net_m3, "net_m3"},
                                                        {SurveyFigure::changed_net_m3, "changed_net_m3"},
                                                        {SurveyFigure::changed_area_m2, "changed_area_m2"},
                                                        {SurveyFigure::greatest_rise_m, "greatest_rise_m"},
                                                        {SurveyFigure::greatest_fall_m, "greatest_fall_m"},
                                                        {SurveyFigure::mean_change_m, "mean_change_m"},
                                                        {SurveyFigure::m3c2_greatest_m, "m3c2_greatest_m"},
                                                        {SurveyFigure::m3c2_mean_m, "m3c2_mean_m"},
                                                        {SurveyFigure::seen_share, "seen_share"}}};

constexpr double kLeastCell_m = 0.02, kMostCell_m = 100.0;

class Checker {
 public:
  void within(double value, double least, double most, const std::string& field, const std::string& range) {
    require(std::isfinite(value) && value >= least && value <= most, field, "must be " + range);
  }
  void require(bool holds, const std::string& field, const std::string& message) {
    if (!holds) errors_.push_back({field, message});
  }
  void thresholds(const FigureThresholds& given, const std::string& field) {
    try {
      check_thresholds(given.thresholds);
    } catch (const InvalidInput& error) {
      for (const FieldError& wrong : error.fields()) errors_.push_back({field + "." + wrong.field, wrong.message});
    }
  }
  void finish() {
    if (!errors_.empty()) throw InvalidInput("The definition of the survey is not usable.", std::move(errors_));
  }

 private:
  std::vector<FieldError> errors_;
};

}  // namespace

std::string_view to_string(ReferencePolicy policy) { return name_of(kPolicies, policy); }
ReferencePolicy parse_reference_policy(std::string_view name) { return value_of(kPolicies, name, "reference"); }

std::string_view to_string(SurveyFigure figure) { return name_of(kFigures, figure); }
SurveyFigure parse_survey_figure(std::string_view name) { return value_of(kFigures, name, "figure"); }

std::string_view unit_of(SurveyFigure figure) {
  const std::string_view name = to_string(figure);
  for (const std::string_view unit : {"m3", "m2", "m"}) {
    if (name.ends_with(unit)) return unit;
  }
  return "";
}

void check_definition(const SurveyDefinition& definition) {
  Checker check;
  check.within(definition.cell_m, kLeastCell_m, kMostCell_m, "cell_m", "0.02 to 100");
  check.within(definition.core_spacing_m, kLeastCell_m, kMostCell_m, "core_spacing_m", "0.02 to 100");
  if (definition.density_t_per_m3) {
    check.within(*definition.density_t_per_m3, 0.01, 25.0, "density_t_per_m3", "0.01 to 25");
  }
  if (definition.greatest_slope_deg) {
    check.within(*definition.greatest_slope_deg, 1.0, 89.0, "greatest_slope_deg", "1 to 89");
  }
  const SurveyReference& reference = definition.reference;
  check.require((reference.policy == ReferencePolicy::fixed) == reference.epoch.has_value(), "reference.epoch",
                "must be given with the policy \"fixed\", and only then");
  check.require((reference.policy == ReferencePolicy::days_ago) == (reference.days > 0), "reference.days",
                "must be 1 or more with the policy \"days_ago\", and is not for others");
  const RegistrationTolerance& tolerance = definition.tolerance;
  check.within(tolerance.residual_m, 1e-4, 10.0, "tolerance.residual_m", "0.0001 to 10");
  check.within(tolerance.uncertainty.position_m, 1e-4, 10.0, "tolerance.position_m", "0.0001 to 10");
  check.within(tolerance.uncertainty.angle_rad, 1e-7, 0.2, "tolerance.angle_deg", "0.00001 to 10");
  for (std::size_t i = 0; i < definition.thresholds.size(); ++i) {
    check.thresholds(definition.thresholds[i], "thresholds." + std::to_string(i));
  }
  check.finish();
}

}  // namespace raywatch
