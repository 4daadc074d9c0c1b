#include "tests/evaluate/error_study.hpp"

#include <algorithm>

#include "tests/evaluate/score_case.hpp"

namespace raywatch::evaluation {
namespace {

constexpr const char* kObjectColumns =
    "place,scan,direction,kind,state,returns,testable,changes,with_others,confidence,change_points,x_m,y_m,z_m,"
    "length_m,width_m,height_m,range_m\n";

const char* kind_of(const Place& place, StateId state) {
  const auto found = std::ranges::find(place.states, state, &LabelledState::id);
  return found == place.states.end() ? "" : found->kind.c_str();
}

/// One line a change that shows the object; one without a change when none does.
void write_fate(const Place& place, const Case& c, const Comparison& comparison, const ObjectFate& fate,
                const char* kind, std::ostream& out) {
  std::vector<const Change*> changes;
  for (const std::size_t change : fate.shown_by) changes.push_back(&comparison.changes[change]);
  if (changes.empty()) changes.push_back(nullptr);
  for (const Change* change : changes) {
    out << place.name << ',' << c.scan << ',' << (fate.removed ? "removed" : "added") << ',' << kind << ','
        << fate.state << ',' << fate.returns << ',' << fate.testable << ',' << fate.changes << ','
        << (fate.with_others ? 1 : 0);
    if (change == nullptr) {
      out << ",,,,,,,,,\n";
      continue;
    }
    const double range_m = (change->centroid_m - place.scans[c.scan].reported_world_from_sensor.position_m).norm();
    out << ',' << change->confidence.value << ',' << change->points << ',' << change->centroid_m.x() << ','
        << change->centroid_m.y() << ',' << change->centroid_m.z() << ',' << change->box.size_m.x() << ','
        << change->box.size_m.y() << ',' << change->box.size_m.z() << ',' << range_m << '\n';
  }
}

void write_objects(const Place& place, const Case& c, const Comparison& comparison, const CaseLabels& labels,
                   std::ostringstream& out) {
  if (out.view().empty()) out << kObjectColumns;
  const ObjectFates fates = fates_of(comparison, labels);
  for (const ObjectFate& fate : fates.objects) {
    write_fate(place, c, comparison, fate, kind_of(place, fate.state), out);
  }
  for (const ObjectFate& fate : fates.false_changes) write_fate(place, c, comparison, fate, "(false)", out);
  for (const ObjectFate& fate : fates.undecided) write_fate(place, c, comparison, fate, "(undecided)", out);
}

}  // namespace

void ErrorStudy::add(const IndexedPlace& place, const CompareParameters& parameters) {
  for (const Case& c : make_cases(place.place(), parameters.contemporary_tolerance, 0)) {
    if (c.against != Against::several && c.against != Against::quiet) continue;
    const CaseViews views = place.refined_views(c, parameters);
    const CaseLabels labels = labels_of(place, c);
    const Comparison comparison = compare(views.scan, views.priors, parameters);
    write_objects(place.place(), c, comparison, labels, objects);
    if (c.against == Against::quiet) continue;
    const Verdicts verdicts = verdicts_of(comparison, views.priors);
    const std::vector<PointError> errors = find_errors(views, labels, verdicts);
    causes.add(errors);
    gallery.add(views, labels, verdicts, errors);
  }
}

}  // namespace raywatch::evaluation
