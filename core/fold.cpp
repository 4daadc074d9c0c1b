#include "core/fold.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace raywatch {

Epoch epoch_of(const ScanView& prior, const ScanView& scan, Duration tolerance) {
  const Duration age = scan.captured_at - prior.captured_at;
  if (std::chrono::abs(age) <= tolerance) return Epoch::contemporary;
  return age > Duration::zero() ? Epoch::earlier : Epoch::later;
}

PointClass class_of_prior_point(Epoch prior) {
  switch (prior) {
    case Epoch::earlier:
      return PointClass::removed;
    case Epoch::later:
      return PointClass::added;
    case Epoch::contemporary:
      break;
  }
  return PointClass::discrepancy;
}

bool is_change(PointClass point_class) {
  return point_class == PointClass::added || point_class == PointClass::removed ||
         point_class == PointClass::discrepancy;
}

PointClass fold_union(std::span<const PriorOpinion> opinions) {
  bool supported = false, occluded = false, discrepancy = false, removed = false;
  for (const auto& [answer, epoch] : opinions) {
    if (answer == Answer::free && epoch == Epoch::earlier) return PointClass::added;
    removed |= answer == Answer::free && epoch == Epoch::later;
    discrepancy |= answer == Answer::free && epoch == Epoch::contemporary;
    supported |= answer == Answer::supported;
    occluded |= answer == Answer::occluded;
  }
  if (removed) return PointClass::removed;
  if (discrepancy) return PointClass::discrepancy;
  if (supported) return PointClass::unchanged;
  return occluded ? PointClass::occluded : PointClass::unseen;
}

PointClass fold_consensus(std::span<const PriorOpinion> opinions, std::span<const std::uint32_t> group) {
  enum class Verdict : std::uint8_t { none, free, supported };
  struct EpochVerdict {
    Verdict verdict = Verdict::none;
    std::uint32_t group = 0;
  };
  std::array<EpochVerdict, 3> verdicts{};
  bool supported = false, free = false, occluded = false;
  for (std::size_t p = 0; p < opinions.size(); ++p) {
    const auto& [answer, epoch] = opinions[p];
    supported |= answer == Answer::supported;
    free |= answer == Answer::free;
    occluded |= answer == Answer::occluded;
    if (answer != Answer::supported && answer != Answer::free) continue;
    EpochVerdict& current = verdicts[static_cast<std::size_t>(epoch)];
    if (current.verdict == Verdict::none) {
      current = {answer == Answer::free ? Verdict::free : Verdict::supported, group[p]};
    } else if (current.group == group[p] && answer == Answer::supported) {
      current.verdict = Verdict::supported;
    }
  }
  const auto is_free = [&](Epoch epoch) { return verdicts[static_cast<std::size_t>(epoch)].verdict == Verdict::free; };
  if (is_free(Epoch::earlier)) return PointClass::added;
  if (is_free(Epoch::later)) return PointClass::removed;
  if (is_free(Epoch::contemporary) && !supported) return PointClass::discrepancy;
  if (supported || free) return PointClass::unchanged;
  return occluded ? PointClass::occluded : PointClass::unseen;
}

PriorOrder order_by_age(std::span<const ScanView> priors, Duration tolerance) {
  PriorOrder order;
  order.newest_first.resize(priors.size());
  std::iota(order.newest_first.begin(), order.newest_first.end(), std::size_t{0});
  std::stable_sort(order.newest_first.begin(), order.newest_first.end(),
                   [&](std::size_t a, std::size_t b) { return priors[a].captured_at > priors[b].captured_at; });
  std::uint32_t group = 0;
  for (std::size_t k = 0; k < priors.size(); ++k) {
    const bool gap =
        k > 0 && priors[order.newest_first[k - 1]].captured_at - priors[order.newest_first[k]].captured_at > tolerance;
    order.group.push_back(gap ? ++group : group);
  }
  return order;
}

}  // namespace raywatch
