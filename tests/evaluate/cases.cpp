#include "tests/evaluate/cases.hpp"

#include <algorithm>

namespace raywatch::evaluation {
namespace {

/// Numbers the states of the place: one a scan.
std::vector<std::size_t> states_of(const Place& place) {
  std::vector<std::size_t> state(place.scans.size(), 0);
  for (std::size_t i = 1; i < state.size(); ++i) {
    state[i] = state[i - 1] + (place.scans[i].present != place.scans[i - 1].present ? 1 : 0);
  }
  return state;
}

bool same_vantage(const SimulatedScan& a, const SimulatedScan& b) {
  return (a.reported_world_from_sensor.position_m - b.reported_world_from_sensor.position_m).norm() < kVantage_m;
}

class CaseMaker {
 public:
  CaseMaker(const Place& place, Duration contemporary)
      : place_(place), contemporary_(contemporary), state_(states_of(place)) {}

  std::vector<Case> pairs() const {
    std::vector<Case> pairs;
    for (std::size_t i = 0; i < place_.scans.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (!is_older(j, i) || place_.scans[i].present == place_.scans[j].present) continue;
        const bool same = same_vantage(place_.scans[i], place_.scans[j]);
        pairs.push_back({same ? Against::same_pose : Against::other_pose, i, {j}});
      }
    }
    return pairs;
  }

  /// The earlier scans of a state, the latest of each vantage, in order of time.
  std::vector<std::size_t> latest_of(std::size_t state, std::size_t scan) const {
    std::vector<std::size_t> priors;
    for (std::size_t j = scan; j-- > 0;) {
      if (state_[j] != state || !is_older(j, scan)) continue;
      const auto sees_from_there = [&](std::size_t p) { return same_vantage(place_.scans[p], place_.scans[j]); };
      if (std::ranges::none_of(priors, sees_from_there)) priors.push_back(j);
    }
    std::ranges::reverse(priors);
    return priors;
  }

  std::vector<Case> groups() const {
    std::vector<Case> groups;
    for (std::size_t i = 0; i < place_.scans.size(); ++i) {
      std::vector<std::size_t> priors;
      if (state_[i] > 0) priors = latest_of(state_[i] - 1, i);
      if (!priors.empty()) groups.push_back({Against::several, i, std::move(priors)});
      priors = latest_of(state_[i], i);
      if (!priors.empty()) groups.push_back({Against::quiet, i, std::move(priors)});
    }
    return groups;
  }

 private:
  bool is_older(std::size_t j, std::size_t i) const {
    return place_.scans[i].captured_at - place_.scans[j].captured_at > contemporary_;
  }

  const Place& place_;
  Duration contemporary_;
  std::vector<std::size_t> state_;
};

}  // namespace

std::vector<Case> make_cases(const Place& place, Duration contemporary, std::size_t most_pairs) {
  const CaseMaker maker(place, contemporary);
  const std::vector<Case> pairs = maker.pairs();
  std::vector<Case> cases;
  const std::size_t kept = std::min(most_pairs, pairs.size());
  for (std::size_t k = 0; k < kept; ++k) cases.push_back(pairs[k * pairs.size() / kept]);
  for (Case& group : maker.groups()) cases.push_back(std::move(group));
  return cases;
}

}  // namespace raywatch::evaluation
