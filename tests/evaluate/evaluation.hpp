#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/profile.hpp"
#include "tests/evaluate/score_case.hpp"

namespace raywatch::evaluation {

/// Parameters under which every case is compared.
struct Setting {
  CompareParameters parameters;             ///< `angle_rad` is overwritten when the next is given
  std::optional<double> angle_per_spacing;  ///< T_a as a multiple of the spacing of the place's shots
  std::vector<Clustering> clusterings;
};

/// The thresholds among which the best ones are looked for.
struct Grid {
  std::vector<double> angle_per_spacing{1.0, 1.5, 2.0, 3.0, 4.5};
  std::vector<double> range_m{0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 1.0};
};

/// What one setting made of all cases of one kind.
struct Tally {
  CaseScore score;
  std::size_t cases = 0;
  double detect_ms = 0.0;  ///< wall time of asking, at the number of threads of the run
  std::size_t asked = 0;   ///< points: the scan's for each prior, and each prior's

  Tally& operator+=(const Tally& other);
};

/// Scores places one after the other and keeps only sums, so that any number of places can be evaluated.
class Evaluation {
 public:
  struct Options {
    Profile profile = Profile::indoor;
    Grid grid;                    ///< empty: only the defaults are scored
    std::size_t most_pairs = 24;  ///< of each place
  };
  explicit Evaluation(Options options);

  /// Compares every case of the place under every setting. Runs in the caller's oneTBB arena.
  void add(const IndexedPlace& place);

  const Options& options() const { return options_; }
  const std::vector<Setting>& settings() const { return settings_; }
  const Tally& tally(Against against, std::size_t setting) const {
    return tallies_[static_cast<std::size_t>(against)][setting];
  }
  /// The spacing of the shots: the mean over the places, in radians.
  double spacing_rad() const;

  /// Where the settings stand: the defaults of `consensus`, of `union`, and then the grid of `union`.
  static constexpr std::size_t kConsensus = 0;
  static constexpr std::size_t kPublished = 1;
  static constexpr std::size_t kFirstOfGrid = 2;

 private:
  static constexpr std::size_t kKinds = 4;

  Options options_;
  std::vector<Setting> settings_;
  std::array<std::vector<Tally>, kKinds> tallies_;
  double spacing_sum_rad_ = 0.0;
  std::size_t places_ = 0;
};

}  // namespace raywatch::evaluation
