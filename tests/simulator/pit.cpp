#include "tests/simulator/pit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "tests/simulator/ground.hpp"
#include "tests/simulator/random.hpp"

namespace raywatch::simulator {
namespace {

constexpr double kHalfPit_m = 120.0;
constexpr double kCell_m = 0.5;
constexpr int kBenches = 3;
constexpr double kBench_m = 12.0;     ///< height
constexpr double kFace_m = 3.5;       ///< how far a face leans back
constexpr double kBermStep_m = 30.0;  ///< from one toe to the next
constexpr int kSections = 6;
constexpr double kSection_m = 30.0;  ///< from one section's middle to the next
constexpr double kHalfBlast_m = 13.0;
constexpr double kBlastDepth_m = 8.0;
constexpr double kThrow_m = 16.0;  ///< how far the rock flies from the old toe
constexpr double kPile_m = 7.5;    ///< height
constexpr std::uint32_t kMostBlasts = 2 * kSections;

/// 0 up to `from`, 1 from `to` on, linear between.
double ramp(double value, const Interval& over) {
  return std::clamp((value - over.from) / (over.to - over.from), 0.0, 1.0);
}

}  // namespace

Pit::Pit(std::uint64_t seed) : seed_(seed) {
  RandomSequence random(seed);
  for (int i = 0; i < kSections; ++i) sections_m_.push_back(kSection_m * (i - 0.5 * (kSections - 1)));
  for (std::size_t i = sections_m_.size(); i > 1; --i) std::swap(sections_m_[i - 1], sections_m_[random.below(i)]);
}

HeightField Pit::ground(std::uint32_t night) const {
  const auto nodes = static_cast<std::uint32_t>(2.0 * kHalfPit_m / kCell_m) + 1;
  const FieldLayout layout{Eigen::Vector2d::Constant(-kHalfPit_m), kCell_m, nodes, nodes};
  return {layout, [&](const Eigen::Vector2d& place_m) { return height_m(place_m, night); }};
}

double Pit::section_middle_m(std::uint32_t blast) const { return sections_m_[blast % sections_m_.size()]; }

double Pit::blasted_share(double y_m, std::uint32_t blast) const {
  return 1.0 - ramp(std::abs(y_m - section_middle_m(blast)), {kHalfBlast_m, kHalfBlast_m + 1.5});
}

double Pit::toe_m(double y_m, std::uint32_t blasts) const {
  double toe = 3.0 * lattice_noise({y_m / 25.0, 0.5}, seed_ + 1) + 0.6 * lattice_noise({y_m / 3.0, 0.5}, seed_ + 2);
  for (std::uint32_t blast = 0; blast < std::min(blasts, kMostBlasts); ++blast) {
    toe += kBlastDepth_m * blasted_share(y_m, blast);
  }
  return toe;
}

double Pit::floor_m(const Eigen::Vector2d& place_m) const {
  return 0.3 * lattice_noise(place_m / 12.0, seed_ + 3) + 0.1 * lattice_noise(place_m / 2.0, seed_ + 4);
}

double Pit::pile_m(const Eigen::Vector2d& place_m, std::uint32_t blast, std::uint32_t night) const {
  const std::uint32_t age = night - blast;
  if (age == 0 || age > 2) return 0.0;
  const double y_from_middle_m = place_m.y() - section_middle_m(blast);
  const double from_toe_m = place_m.x() - toe_m(place_m.y(), blast);
  double height = kPile_m * ramp(from_toe_m, {-kThrow_m, 2.0});
  height *= 1.0 - ramp(std::abs(y_from_middle_m), {kHalfBlast_m - 3.0, kHalfBlast_m + 4.0});
  if (age == 2) height *= 1.0 - ramp(y_from_middle_m, {-1.5, 1.5});
  const double rubble = 1.0 + 0.12 * lattice_noise(place_m / 1.5, seed_ + 10 + blast);
  return from_toe_m > kBlastDepth_m + kFace_m ? 0.0 : height * rubble;
}

double Pit::height_m(const Eigen::Vector2d& place_m, std::uint32_t night) const {
  const double floor = floor_m(place_m);
  double ground = floor;
  for (int bench = 0; bench < kBenches; ++bench) {
    const double toe = bench == 0
                           ? toe_m(place_m.y(), night)
                           : bench * kBermStep_m + 3.0 * lattice_noise({place_m.y() / 20.0, bench + 0.5}, seed_ + 5);
    ground += kBench_m * ramp(place_m.x(), {toe, toe + kFace_m});
  }
  ground += 10.0 * ramp(-place_m.x(), {105.0, 111.0}) + 10.0 * ramp(std::abs(place_m.y()), {108.0, 114.0});
  for (std::uint32_t blast = night > 2 ? night - 2 : 0; blast < std::min(night, kMostBlasts); ++blast) {
    ground = std::max(ground, floor + pile_m(place_m, blast, night));
  }
  return ground;
}

namespace {

constexpr double kRounding_m = 1e-6;
constexpr double kClearlyGone_m = 0.3;

/// How a surface of one night stands to another night.
enum class Standing { there, unclear, gone };

class NightComparison {
 public:
  explicit NightComparison(const std::vector<std::shared_ptr<const HeightField>>& nights) : nights_(nights) {}

  const FieldLayout& layout() const { return nights_.front()->layout(); }

  std::array<std::size_t, 4> corners(std::size_t cell) const {
    const std::size_t columns = layout().columns - 1;
    const std::size_t node = cell / columns * layout().columns + cell % columns;
    return {node, node + 1, node + layout().columns, node + layout().columns + 1};
  }
  Standing standing(std::size_t cell, std::size_t night, std::size_t other) const {
    const std::vector<double>& here_m = nights_[night]->heights_m();
    const std::vector<double>& there_m = nights_[other]->heights_m();
    double least_m = kNowhere_m;
    double most_m = -kNowhere_m;
    for (const std::size_t node : corners(cell)) {
      least_m = std::min(least_m, here_m[node] - there_m[node]);
      most_m = std::max(most_m, here_m[node] - there_m[node]);
    }
    if (most_m <= kRounding_m) return Standing::there;
    // Above a steep surface the vertical distance to it is much larger than the true one.
    return least_m * nights_[other]->normal(middle_m(cell)).z() >= kClearlyGone_m ? Standing::gone : Standing::unclear;
  }
  /// The nights in which the surface is there; nothing if one of them is unclear.
  std::optional<std::uint64_t> nights_there(std::size_t cell, std::size_t night) const {
    std::uint64_t there = 0;
    for (std::size_t other = 0; other < nights_.size(); ++other) {
      const Standing standing_there = standing(cell, night, other);
      if (standing_there == Standing::unclear) return std::nullopt;
      if (standing_there == Standing::there) there |= std::uint64_t{1} << other;
    }
    return there;
  }
  /// Adds the cell, as the night shows it, to its state.
  void extend(GroundState& state, std::size_t cell, std::size_t night) const {
    double free_depth_m = kNowhere_m;
    for (std::size_t other = 0; other < nights_.size(); ++other) {
      if ((state.nights >> other & 1) != 0) continue;
      const double fall_m = mean_m(cell, night) - mean_m(cell, other);
      free_depth_m = std::min(free_depth_m, fall_m);
    }
    const Eigen::Vector2d half_m = Eigen::Vector2d::Constant(0.5 * layout().cell_m);
    const Eigen::Vector2d low_m = middle_m(cell) - half_m;
    const Eigen::Vector2d high_m = middle_m(cell) + half_m;
    const double top_m = mean_m(cell, night);
    state.box.extend(Eigen::Vector3d(low_m.x(), low_m.y(), top_m - free_depth_m));
    state.box.extend(Eigen::Vector3d(high_m.x(), high_m.y(), top_m));
    state.volume_m3 += free_depth_m * layout().cell_m * layout().cell_m;
  }

 private:
  static constexpr double kNowhere_m = 1e300;

  Eigen::Vector2d middle_m(std::size_t cell) const {
    const std::size_t columns = layout().columns - 1;
    const Eigen::Vector2d index(static_cast<double>(cell % columns), static_cast<double>(cell / columns));
    return layout().origin_m + layout().cell_m * (index + Eigen::Vector2d::Constant(0.5));
  }
  double mean_m(std::size_t cell, std::size_t night) const {
    double sum_m = 0.0;
    for (const std::size_t node : corners(cell)) sum_m += nights_[night]->heights_m()[node];
    return 0.25 * sum_m;
  }

  const std::vector<std::shared_ptr<const HeightField>>& nights_;
};

}  // namespace

GroundTruth compare_nights(const std::vector<std::shared_ptr<const HeightField>>& nights, StateId first_id) {
  constexpr std::size_t kMostNights = 64;
  if (nights.empty() || nights.size() > kMostNights) throw std::length_error("the ground must have 1 to 64 nights");
  const NightComparison comparison(nights);
  const std::uint64_t every_night = ~std::uint64_t{0} >> (kMostNights - nights.size());
  GroundTruth truth;
  for (std::size_t night = 0; night < nights.size(); ++night) {
    auto states = std::make_shared<CellStates>(comparison.layout().cell_count(), kBackground);
    for (std::size_t cell = 0; cell < states->size(); ++cell) {
      const auto there = comparison.nights_there(cell, night);
      if (!there) (*states)[cell] = kNoSurface;
      if (!there || *there == every_night) continue;
      auto found = std::ranges::find(truth.states, *there, &GroundState::nights);
      if (found == truth.states.end()) found = truth.states.insert(found, {.nights = *there, .box = {}});
      (*states)[cell] = static_cast<StateId>(first_id + (found - truth.states.begin()));
      // A surface that an earlier night showed too was counted there.
      const bool shown_before = night > 0 && (*truth.cells.back())[cell] == (*states)[cell];
      if (!shown_before) comparison.extend(*found, cell, night);
    }
    truth.cells.push_back(std::move(states));
  }
  return truth;
}

}  // namespace raywatch::simulator
