#include "core/changed_ground.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace raywatch {
namespace {

/// After the first judgement with the poses as told: what is unchanged hardly moves after these.
constexpr int kRounds = 2;

/// Calls `visit` with each of the up to eight cells around one.
template <class Visit>
void for_each_beside(const GridLayout& layout, std::size_t cell, Visit visit) {
  const auto column = static_cast<std::int64_t>(cell % layout.columns);
  const auto row = static_cast<std::int64_t>(cell / layout.columns);
  for (std::int64_t j = std::max<std::int64_t>(row - 1, 0); j <= std::min<std::int64_t>(row + 1, layout.rows - 1);
       ++j) {
    for (std::int64_t i = std::max<std::int64_t>(column - 1, 0);
         i <= std::min<std::int64_t>(column + 1, layout.columns - 1); ++i) {
      if (i != column || j != row) visit(static_cast<std::size_t>(j) * layout.columns + static_cast<std::size_t>(i));
    }
  }
}

void judge(const GridLayout& layout, std::span<const DifferenceCell> difference, ChangedGround& ground) {
  tbb::parallel_for(std::size_t{0}, difference.size(), [&](std::size_t cell) {
    ground.cells[cell] = {};
    if (!difference[cell].seen()) return;
    const PoseLeverage leverage = ground.poses.leverage_of(cell);
    const double rise_m = difference[cell].rise_m - ground.poses.rise(leverage);
    const double random_m = difference[cell].random_sigma_m;
    const double sigma_m = std::sqrt(random_m * random_m + ground.poses.variance(leverage));
    const bool surely = std::abs(rise_m) > kTwoSided95 * sigma_m;
    ground.cells[cell] = {rise_m, static_cast<std::int8_t>(!surely ? 0 : rise_m > 0.0 ? 1 : -1), surely};
  });
  for (std::size_t cell = 0; cell < difference.size(); ++cell) {
    ChangedCell& at = ground.cells[cell];
    if (!difference[cell].seen() || at.surely) continue;
    int rises = 0, falls = 0;
    double sum_m = 0.0;
    for_each_beside(layout, cell, [&](std::size_t beside) {
      const ChangedCell& other = ground.cells[beside];
      if (!other.surely) return;
      ++(other.sign > 0 ? rises : falls);
      sum_m += other.rise_m;
    });
    if (rises + falls == 0) continue;
    const bool up = rises == falls ? sum_m > 0.0 : rises > falls;
    at.sign = up ? 1 : -1;
  }
}

}  // namespace

ChangedGround changed_ground(const ElevationModel& before, const ElevationModel& after) {
  const std::vector<DifferenceCell> difference = difference_of(before, after);
  ChangedGround ground{std::vector<ChangedCell>(difference.size()), PoseErrors(before, after)};
  judge(before.layout, difference, ground);
  std::vector<std::uint8_t> stable(difference.size());
  for (int round = 0; round < kRounds; ++round) {
    std::ranges::transform(ground.cells, stable.begin(),
                           [](const ChangedCell& cell) { return cell.sign == 0 ? 1 : 0; });
    ground.poses.learn(difference, stable);
    judge(before.layout, difference, ground);
  }
  return ground;
}

}  // namespace raywatch
