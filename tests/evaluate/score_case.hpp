#pragma once

#include "tests/evaluate/indexed_place.hpp"
#include "tests/evaluate/objects.hpp"
#include "tests/evaluate/score.hpp"

namespace raywatch::evaluation {

/// The truth about a case. Asks the scans about each other once, to find what can be tested.
CaseLabels labels_of(const IndexedPlace& place, const Case& c);

/// How changed points become changes: d and m of `CompareParameters`.
struct Clustering {
  double distance_m = 0.1;
  std::size_t min_points = 40;
  friend bool operator==(const Clustering&, const Clustering&) = default;
};

struct CaseScore {
  Counts single;           ///< of points before clustering
  Counts single_in_sight;  ///< the same without changed points that no method could find
  struct Clustered {
    Counts points;
    Counts in_sight;
    ObjectScore objects;
  };
  std::vector<Clustered> clustered;  ///< one for each clustering

  /// Sums; a score without clusterings takes those of the other.
  CaseScore& operator+=(const CaseScore& other);
};

struct TimedScore {
  CaseScore score;
  double detect_ms = 0.0;  ///< wall time of `detect`
};

/// Compares a case once and scores it without clusters and with each clustering.
TimedScore score_case(const IndexedPlace& place, const Case& c, const CaseLabels& labels,
                      const CompareParameters& parameters, std::span<const Clustering> clusterings);

}  // namespace raywatch::evaluation
