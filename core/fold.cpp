#include "core/fold.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace raywatch {

Epoch epoch_of(const ScanView& prior, const ScanView& scan, Duration tolerance) {
  const Duration age = between(prior.captured_at, scan.captured_at);
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

namespace {

/// What the priors say about a point in `union`, as a set of bits; the first that is there decides.
enum UnionBit : std::uint8_t { kAdded = 1, kRemoved = 2, kDiscrepancy = 4, kSupported = 8, kOccluded = 16 };

UnionBit bit_of_free(Epoch epoch) {
  switch (epoch) {
    case Epoch::earlier:
      return kAdded;
    case Epoch::later:
      return kRemoved;
    case Epoch::contemporary:
      break;
  }
  return kDiscrepancy;
}

std::uint8_t bits_of(Answer answer, Epoch epoch) {
  switch (answer) {
    case Answer::free:
      return bit_of_free(epoch);
    case Answer::supported:
      return kSupported;
    case Answer::occluded:
      return kOccluded;
    case Answer::unseen:
    case Answer::ambiguous:
      break;
  }
  return 0;
}

PointClass class_of_bits(std::uint8_t bits) {
  if (bits & kAdded) return PointClass::added;
  if (bits & kRemoved) return PointClass::removed;
  if (bits & kDiscrepancy) return PointClass::discrepancy;
  if (bits & kSupported) return PointClass::unchanged;
  return bits & kOccluded ? PointClass::occluded : PointClass::unseen;
}

}  // namespace

PointClass fold_union(std::span<const PriorOpinion> opinions) {
  std::uint8_t bits = 0;
  for (const auto& [answer, epoch] : opinions) bits |= bits_of(answer, epoch);
  return class_of_bits(bits);
}

void fold_union(std::span<const std::vector<Answer>> answers, std::span<const Epoch> epochs, std::size_t begin,
                std::span<PointClass> classes) {
  constexpr std::size_t kAnswers = 5, kSets = 32;
  std::array<PointClass, kSets> class_of;
  for (std::size_t bits = 0; bits < kSets; ++bits) class_of[bits] = class_of_bits(static_cast<std::uint8_t>(bits));
  std::vector<std::uint8_t> bits(classes.size(), 0);
  for (std::size_t p = 0; p < answers.size(); ++p) {
    std::array<std::uint8_t, kAnswers> bits_of_answer;
    for (std::size_t k = 0; k < kAnswers; ++k) bits_of_answer[k] = bits_of(static_cast<Answer>(k), epochs[p]);
    for (std::size_t i = 0; i < classes.size(); ++i) {
      bits[i] |= bits_of_answer[static_cast<std::size_t>(answers[p][begin + i])];
    }
  }
  for (std::size_t i = 0; i < classes.size(); ++i) classes[i] = class_of[bits[i]];
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
    const bool gap = k > 0 && between(priors[order.newest_first[k]].captured_at,
                                      priors[order.newest_first[k - 1]].captured_at) > tolerance;
    order.group.push_back(gap ? ++group : group);
  }
  return order;
}

}  // namespace raywatch
