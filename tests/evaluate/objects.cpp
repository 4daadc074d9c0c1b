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

/// Of one direction: of what came, or of what went.
struct Direction {
  bool removed = false;
  RealChanges real;
};

void judge_change(const Content& content, ObjectFate fate, ObjectFates& fates) {
  std::size_t changed = 0;
  for (const auto& [state, points] : content.changed) changed += points;
  if (content.counted == 0) {
    fates.undecided.push_back(std::move(fate));
  } else if (static_cast<double>(changed) < kTrueShare * static_cast<double>(content.counted)) {
    fates.false_changes.push_back(std::move(fate));
  }
}

void judge_direction(const Direction& direction, const Comparison& comparison, const std::vector<Content>& contents,
                     ObjectFates& fates) {
  std::map<StateId, ObjectFate> shown;
  for (std::size_t c = 0; c < contents.size(); ++c) {
    if ((comparison.changes[c].kind == ChangeKind::removed) != direction.removed) continue;
    judge_change(contents[c], {.removed = direction.removed, .returns = comparison.changes[c].points, .shown_by = {c}},
                 fates);
    const std::vector<StateId> objects = shown_by(contents[c], direction.real);
    for (const StateId object : objects) {
      ObjectFate& fate = shown[object];
      ++fate.changes;
      fate.with_others |= objects.size() > 1;
      fate.shown_by.push_back(c);
    }
  }
  for (const auto& [state, returns] : direction.real) {
    if (returns.testable < kLeastReturns) continue;
    ObjectFate& fate = shown[state];
    fate.removed = direction.removed;
    fate.state = state;
    fate.returns = returns.all;
    fate.testable = returns.testable;
    fates.objects.push_back(fate);
  }
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

ObjectFates fates_of(const Comparison& comparison, const CaseLabels& labels) {
  Direction came, went{.removed = true};
  add_real(*labels.scan, labels.truth.scan, labels.testable_scan, came.real);
  for (std::size_t p = 0; p < labels.priors.size(); ++p) {
    add_real(*labels.priors[p], labels.truth.priors[p], labels.testable_priors[p], went.real);
  }
  const std::vector<Content> contents = contents_of(comparison, labels);
  ObjectFates fates;
  for (const Direction* direction : {&came, &went}) judge_direction(*direction, comparison, contents, fates);
  return fates;
}

ObjectScore count_objects(const Comparison& comparison, const CaseLabels& labels) {
  const ObjectFates fates = fates_of(comparison, labels);
  ObjectScore score{.comparisons = 1};
  const auto of = [&](const ObjectFate& fate) -> ObjectCounts& { return fate.removed ? score.removed : score.added; };
  for (const ObjectFate& fate : fates.objects) {
    ObjectCounts& counts = of(fate);
    ++counts.real;
    counts.found += fate.changes > 0;
    counts.split += fate.changes > 1;
    counts.merged += fate.with_others;
    counts.once += fate.changes == 1 && !fate.with_others;
  }
  for (const ObjectFate& fate : fates.false_changes) ++of(fate).false_;
  for (const ObjectFate& fate : fates.undecided) ++of(fate).undecided;
  return score;
}

}  // namespace raywatch::evaluation
