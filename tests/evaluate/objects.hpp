#pragma once

#include <cstddef>
#include <vector>

#include "core/compare.hpp"
#include "tests/evaluate/score.hpp"

/// How results are scored against the truth, object by object.
namespace raywatch::evaluation {

/// A real change counts when at least so many of its returns can be tested: of one that came those in the scan, of one
/// that went those in the prior that has the most.
inline constexpr std::size_t kLeastReturns = 15;
/// A change with a smaller share of truly changed points is false.
inline constexpr double kTrueShare = 0.2;

/// Real changes, and what was made of them. A change shows an object when the object has a fifth of the change's
/// points, or the change has half of the object's returns.
struct ObjectCounts {
  std::size_t real = 0;       ///< objects that came (or went) and can be tested
  std::size_t found = 0;      ///< shown by at least one change
  std::size_t once = 0;       ///< shown by exactly one, which shows no other object
  std::size_t split = 0;      ///< shown by several
  std::size_t merged = 0;     ///< shown together with another object
  std::size_t false_ = 0;     ///< changes in which less than a fifth of the points truly changed
  std::size_t undecided = 0;  ///< changes all of whose points lie on no surface

  ObjectCounts& operator+=(const ObjectCounts& other);
  friend bool operator==(const ObjectCounts&, const ObjectCounts&) = default;
};

struct ObjectScore {
  ObjectCounts added, removed;
  std::size_t comparisons = 0;

  ObjectCounts both() const;
  ObjectScore& operator+=(const ObjectScore& other);
  friend bool operator==(const ObjectScore&, const ObjectScore&) = default;
};

/// The labels of a case's scans, its truth, and which of its points can be tested.
struct CaseLabels {
  const SimulatedScan* scan = nullptr;
  std::vector<const SimulatedScan*> priors;
  CaseTruth truth;
  std::vector<std::uint8_t> testable_scan;                 ///< by a prior
  std::vector<std::vector<std::uint8_t>> testable_priors;  ///< by the scan
  CaseTruth in_sight;  ///< the truth in which changed points are ignored that cannot be tested
};

/// What became of one real change that can be tested, or of one change that is false.
struct ObjectFate {
  bool removed = false;               ///< else added
  StateId state = 0;                  ///< of the object; 0: a change that is false or undecided
  std::size_t returns = 0;            ///< of the object, in the scan or in all priors together; of a change: its points
  std::size_t testable = 0;           ///< of these: in the scan, or in the prior that has the most
  std::size_t changes = 0;            ///< that show the object
  bool with_others = false;           ///< one of those shows another object, too
  std::vector<std::size_t> shown_by;  ///< numbers of these changes, or of the false one
};

struct ObjectFates {
  std::vector<ObjectFate> objects, false_changes, undecided;
};

/// What became of every object that came or went and has at least `kLeastReturns` that can be tested.
ObjectFates fates_of(const Comparison& comparison, const CaseLabels& labels);

/// The same in numbers.
ObjectScore count_objects(const Comparison& comparison, const CaseLabels& labels);

}  // namespace raywatch::evaluation
