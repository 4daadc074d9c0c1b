#include "core/compare.hpp"

#include "core/names.hpp"

namespace raywatch {
namespace {

constexpr Names<Grouping, 2> kGroupings{{{Grouping::union_, "union"}, {Grouping::consensus, "consensus"}}};
constexpr Names<PointClass, kPointClasses> kPointClassNames{{{PointClass::unchanged, "unchanged"},
                                                             {PointClass::added, "added"},
                                                             {PointClass::removed, "removed"},
                                                             {PointClass::discrepancy, "discrepancy"},
                                                             {PointClass::occluded, "occluded"},
                                                             {PointClass::unseen, "unseen"},
                                                             {PointClass::invalid, "invalid"}}};

}  // namespace

std::string_view to_string(Grouping grouping) { return name_of(kGroupings, grouping); }
Grouping parse_grouping(std::string_view name) { return value_of(kGroupings, name, "grouping"); }
std::string_view to_string(PointClass point_class) { return name_of(kPointClassNames, point_class); }
PointClass parse_point_class(std::string_view name) { return value_of(kPointClassNames, name, "class"); }

UsableRange usable_range(const SensorModel& sensor, const CompareParameters& parameters) {
  UsableRange usable{.min_m = parameters.min_range_m, .max_m = parameters.max_range_m};
  if (parameters.grouping == Grouping::union_) return usable;
  usable.min_m = std::max(usable.min_m, sensor.min_range_m.value_or(0.0));
  usable.max_m = std::min(usable.max_m, sensor.max_range_m.value_or(parameters.max_range_m));
  usable.no_return_m = sensor.no_return_m;
  return usable;
}

Comparison compare(const ScanView& scan, std::span<const ScanView> priors, const CompareParameters& parameters) {
  return form_changes(scan, priors, parameters, detect(scan, priors, parameters));
}

}  // namespace raywatch
