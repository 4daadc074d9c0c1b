#include "tests/evaluate/error_study.hpp"

#include "tests/evaluate/score_case.hpp"

namespace raywatch::evaluation {

void ErrorStudy::add(const IndexedPlace& place, const CompareParameters& parameters) {
  for (const Case& c : make_cases(place.place(), parameters.contemporary_tolerance, 0)) {
    if (c.against != Against::several) continue;
    const CaseViews views = place.refined_views(c, parameters);
    const CaseLabels labels = labels_of(place, c);
    const Verdicts verdicts = verdicts_of(compare(views.scan, views.priors, parameters), views.priors);
    const std::vector<PointError> errors = find_errors(views, labels, verdicts);
    causes.add(errors);
    gallery.add(views, labels, verdicts, errors);
  }
}

}  // namespace raywatch::evaluation
