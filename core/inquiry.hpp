#pragma once

#include <algorithm>
#include <array>

#include "core/ask_kernels.hpp"
#include "core/question.hpp"

namespace raywatch {

/// What the bounds of cells have told about a point, and the cells whose returns must be looked at to tell more.
struct Remains {
  static constexpr std::size_t kMostCells = 64;
  bool is_complete = false;    ///< if not, everything must be asked anew
  bool is_surrounded = false;  ///< if not, the point may still be surrounded by returns in the cone
  Evidence evidence;
  std::uint32_t count = 0;
  std::array<std::uint32_t, kMostCells> cells;

  void add(std::uint32_t cell) {
    if (count < kMostCells) {
      cells[count++] = cell;
    } else {
      is_complete = false;
    }
  }
};

/// Asks about one point at a time, return by return, in double precision.
class Inquiry {
 public:
  explicit Inquiry(const PreparedPrior& prior) : prior_(prior), thresholds_(prior.thresholds) {}

  Answer answer(const std::array<double, 3>& point_m, const Direction& direction, const Remains& remains) const {
    const Question question(point_m[0], point_m[1], point_m[2], thresholds_);
    if (!(question.range_m() > 0.0)) return Answer::unseen;
    const auto is_enough = [](const Evidence& evidence) { return evidence.supported; };
    if (!remains.is_complete) return ask_every_cell(question, direction, is_enough);
    const Evidence evidence = look_at_cells(question, remains, is_enough);
    const bool in_front = evidence.any && !evidence.not_farther;
    if (!in_front || evidence.surrounded()) return evidence.answer();
    return remains.is_surrounded ? Answer::free : ask_every_cell(question, direction, is_enough);
  }

  /// Whether the answer is free, which any return that is not farther denies.
  bool is_free(const std::array<double, 3>& point_m, const Direction& direction, const Remains& remains) const {
    const Question question(point_m[0], point_m[1], point_m[2], thresholds_);
    if (!(question.range_m() > 0.0)) return false;
    const auto is_enough = [](const Evidence& evidence) { return evidence.not_farther; };
    if (remains.is_complete) {
      if (look_at_cells(question, remains, is_enough).not_farther) return false;
      if (remains.is_surrounded) return true;
    }
    return ask_every_cell(question, direction, is_enough) == Answer::free;
  }

 private:
  template <class IsEnough>
  Evidence look_at_cells(const Question& question, const Remains& remains, IsEnough is_enough) const {
    Evidence evidence = remains.evidence;
    for (std::uint32_t k = 0; k < remains.count && !is_enough(evidence); ++k) {
      look_at_cell(question, remains.cells[k], evidence);
    }
    return evidence;
  }

  void look_at_cell(const Question& question, std::uint32_t cell, Evidence& evidence) const {
    for (std::uint32_t i = prior_.index.first[cell]; i < prior_.index.first[cell + 1]; ++i) {
      const Return& r = prior_.index.returns[i];
      evidence.look_at(question, r.x_m, r.y_m, r.z_m);
    }
  }

  template <class IsEnough>
  Answer ask_every_cell(const Question& question, const Direction& direction, IsEnough is_enough) const {
    Evidence evidence;
    prior_.cone.for_each_cell(prior_.index.grid, direction, [&](std::uint32_t cell, bool inside) {
      if (!adds_nothing(question, cell, inside, evidence)) look_at_cell(question, cell, evidence);
      return !is_enough(evidence);
    });
    return evidence.answer();
  }

  /// Skips the cell's returns when its bounds already say all that they could add, and adds that.
  bool adds_nothing(const Question& question, std::uint32_t cell, bool inside, Evidence& evidence) const {
    const double least_m = prior_.index.least_m[cell], greatest_m = prior_.index.greatest_m[cell];
    if (least_m > greatest_m) return true;
    const double range_m = question.range_m(), rounding_m = 2.0 * kRangeError * range_m;
    const double within_m = thresholds_.range_m - rounding_m;
    if (inside && (std::abs(least_m - range_m) < within_m || std::abs(greatest_m - range_m) < within_m)) {
      evidence.any = evidence.supported = evidence.not_farther = evidence.not_nearer = true;
      return true;
    }
    if (greatest_m <= range_m - thresholds_.range_m - rounding_m && (inside || evidence.not_farther)) {
      evidence.any |= inside;
      evidence.not_farther = true;
      return true;
    }
    if (least_m >= range_m + thresholds_.range_m + rounding_m && (inside || evidence.not_nearer) &&
        (evidence.not_farther || evidence.surrounded())) {
      evidence.any |= inside;
      evidence.not_nearer = true;
      return true;
    }
    return false;
  }

  const PreparedPrior& prior_;
  SquaredThresholds thresholds_;
};

}  // namespace raywatch
