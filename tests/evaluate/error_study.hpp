#pragma once

#include "tests/evaluate/gallery.hpp"

namespace raywatch::evaluation {

/// What is wrong with what the defaults of a grouping find against several priors, with clusters.
struct ErrorStudy {
  CauseTable causes;
  Gallery gallery;

  void add(const IndexedPlace& place, const CompareParameters& parameters);
};

}  // namespace raywatch::evaluation
