#include "tests/evaluate/objects.hpp"

#include <algorithm>
#include <map>

namespace raywatch::evaluation {
namespace {

struct Returns {
  std::size_t all = 0;
  std::size_t testable = 0;  ///< in the scan, or in the prior that has the most
};
using RealChanges = std::map<StateId, Returns>;

/// What one change consists of.
struct Content {
  std::map<StateId, std::size_t> changed;
  std::size_t counted = 0;  ///< points that lie on a surface
};

void add_real(const SimulatedScan& scan, const std::vector<Truth>& truth, const std::vector<std::uint8_t>& testable,
              RealChanges& real) {
  RealChanges here;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] != Truth::changed) continue;
    Returns& returns = here[scan.labels[i]];
    ++returns.all;
    returns.testable += testable[i];
  }
  for (const auto& [state, returns] : here) {
    Returns& sum = real[state];
    sum.all += returns.all;
    sum.testable = std::max(sum.testable, returns.testable);
  }
}

void add_point(Truth truth, StateId label, Content& content) {
  if (truth == Truth::ignored) return;
  ++content.counted;
  if (truth == Truth::changed) ++content.changed[label];
}

std::vector<Content> contents_of(const Comparison& comparison, const CaseLabels& labels) {
  std::vector<Content> contents(comparison.changes.size());
  for (std::size_t i = 0; i < comparison.change_of.size(); ++i) {
    const std::int32_t change = comparison.change_of[i];
    if (change >= 0) add_point(labels.truth.scan[i], labels.scan->labels[i], contents[change]);
  }
  for (const PriorPoint& point : comparison.prior_points) {
    if (point.change < 0) continue;
    add_point(labels.truth.priors[point.prior][point.index], labels.priors[point.prior]->labels[point.index],
              contents[point.change]);
  }
  return contents;
}

/// The real changes that a change shows.
std::vector<StateId> shown_by(const Content& content, const RealChanges& real) {
  std::vector<StateId> shown;
  for (const auto& [state, points] : content.changed) {
    const auto found = real.find(state);
    if (found == real.end()) continue;
    const bool large_share = static_cast<double>(points) >= kTrueShare * static_cast<double>(content.counted);
    if (large_share || 2 * points >= found->second.all) shown.push_back(state);
  }
  return shown;
}

void judge_change(const Content& content, ObjectCounts& counts) {
  std::size_t changed = 0;
  for (const auto& [state, points] : content.changed) changed += points;
  if (content.counted == 0) {
    ++counts.undecided;
  } else if (static_cast<double>(changed) < kTrueShare * static_cast<double>(content.counted)) {
    ++counts.false_;
  }
}

/// Scores the changes of one direction: those that came, or those that went.
ObjectCounts count_direction(const std::vector<const Content*>& contents, const RealChanges& real) {
  struct Shown {
    std::size_t changes = 0;
    bool with_others = false;
  };
  ObjectCounts counts;
  std::map<StateId, Shown> shown;
  for (const Content* content : contents) {
    judge_change(*content, counts);
    const std::vector<StateId> objects = shown_by(*content, real);
    for (const StateId object : objects) {
      ++shown[object].changes;
      shown[object].with_others |= objects.size() > 1;
    }
  }
  for (const auto& [state, returns] : real) {
    if (returns.testable < kLeastReturns) continue;
    const Shown& found = shown[state];
    ++counts.real;
    counts.found += found.changes > 0;
    counts.split += found.changes > 1;
    counts.merged += found.with_others;
    counts.once += found.changes == 1 && !found.with_others;
  }
  return counts;
}

}  // namespace

ObjectCounts& ObjectCounts::operator+=(const ObjectCounts& other) {
  real += other.real;
  found += other.found;
  once += other.once;
  split += other.split;
  merged += other.merged;
  false_ += other.false_;
  undecided += other.undecided;
  return *this;
}

ObjectCounts ObjectScore::both() const {
  ObjectCounts sum = added;
  return sum += removed;
}

ObjectScore& ObjectScore::operator+=(const ObjectScore& other) {
  added += other.added;
  removed += other.removed;
  comparisons += other.comparisons;
  return *this;
}

ObjectScore count_objects(const Comparison& comparison, const CaseLabels& labels) {
  RealChanges came, went;
  add_real(*labels.scan, labels.truth.scan, labels.testable_scan, came);
  for (std::size_t p = 0; p < labels.priors.size(); ++p) {
    add_real(*labels.priors[p], labels.truth.priors[p], labels.testable_priors[p], went);
  }
  const std::vector<Content> contents = contents_of(comparison, labels);
  std::vector<const Content*> added, removed;
  for (std::size_t c = 0; c < contents.size(); ++c) {
    (comparison.changes[c].kind == ChangeKind::removed ? removed : added).push_back(&contents[c]);
  }
  return {count_direction(added, came), count_direction(removed, went), 1};
}

}  // namespace raywatch::evaluation
