#pragma once

#include <sstream>

#include "tests/evaluate/gallery.hpp"

namespace raywatch::evaluation {

/// What is wrong with what the defaults of a grouping find against several priors, with clusters.
struct ErrorStudy {
  CauseTable causes;
  Gallery gallery;
  /// One line for each real change and each false one, as CSV with a head.
  std::ostringstream objects;

  void add(const IndexedPlace& place, const CompareParameters& parameters);
};

}  // namespace raywatch::evaluation
