#pragma once

#include <filesystem>

#include "tests/evaluate/evaluation.hpp"

namespace raywatch::evaluation {

/// Writes what the grid of `union` gives, with and without clusters, as data and as gnuplot scripts: f against T_r for
/// each T_a, and precision against recall. Against several priors; where no case has them, single pairs. Creates the
/// folder.
void write_plots(const Evaluation& evaluation, const std::filesystem::path& folder);

/// Runs gnuplot on the scripts, which makes an SVG of each.
/// @returns false when gnuplot cannot be run or fails.
bool draw_plots(const std::filesystem::path& folder);

}  // namespace raywatch::evaluation
