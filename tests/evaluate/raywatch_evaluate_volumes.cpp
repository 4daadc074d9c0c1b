/// Measures volumes of simulated pits against the truth, and whether their intervals hold it as often as they say.

#include <oneapi/tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "tests/evaluate/volume_case.hpp"

namespace raywatch::evaluation {
namespace {

/// How one figure stood to the truth over many cases.
class Record {
 public:
  void add(const VolumeFigure& figure, double truth_m3) {
    const double error_m3 = figure.value_m3 - truth_m3;
    ++cases_;
    held_ += truth_m3 >= figure.low_m3() && truth_m3 <= figure.high_m3() ? 1 : 0;
    error_ += error_m3;
    error2_ += error_m3 * error_m3;
    score2_ += std::pow(error_m3 / figure.sigma_m3(), 2.0);
    width_ += figure.high_m3() - figure.low_m3();
    random_ += figure.random_sigma_m3;
    pose_ += figure.pose_sigma_m3;
  }
  void print(const char* name) const {
    const auto n = static_cast<double>(cases_);
    std::printf("| %s | %d of %d | %.1f | %.1f | %.1f | %.1f | %.1f | %.2f |\n", name, held_, cases_, width_ / n,
                random_ / n, pose_ / n, error_ / n, std::sqrt(error2_ / n), std::sqrt(score2_ / n));
  }

 private:
  int cases_ = 0, held_ = 0;
  double error_ = 0.0, error2_ = 0.0, score2_ = 0.0, width_ = 0.0, random_ = 0.0, pose_ = 0.0;
};

void report(const std::vector<VolumeCase>& cases) {
  Record net, changed, cut, fill;
  int within = 0, bounded = 0;
  double seen = 0.0, moved = 0.0, bounds = 0.0, worst = 0.0;
  for (const VolumeCase& c : cases) {
    const ZoneVolumes& v = c.volumes;
    net.add(v.net, c.net_m3);
    changed.add(v.changed_net, c.net_m3);
    cut.add(v.cut, c.cut_m3);
    fill.add(v.fill, c.fill_m3);
    const double tolerance_m3 = std::max(0.02 * (c.cut_m3 + c.fill_m3), 1.96 * v.net.sigma_m3());
    worst = std::max(worst, std::abs(v.net.value_m3 - c.net_m3) / tolerance_m3);
    within += std::abs(v.net.value_m3 - c.net_m3) <= tolerance_m3 ? 1 : 0;
    bounded += c.whole_net_m3 >= v.whole().low_m3 && c.whole_net_m3 <= v.whole().high_m3 ? 1 : 0;
    bounds += v.whole().high_m3 - v.whole().low_m3;
    seen += v.seen_share();
    moved += c.cut_m3 + c.fill_m3;
  }
  const auto n = static_cast<double>(cases.size());
  std::printf(
      "| figure | interval holds the truth | mean width, m3 | sigma random | sigma poses | mean error | "
      "RMS error | RMS error / sigma |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  net.print("net, all seen cells");
  changed.print("net, changed cells");
  cut.print("cut");
  fill.print("fill");
  std::printf(
      "\nSeen in both epochs: %.1f %% of the zone. True cut + fill there: %.0f m3 on average.\n"
      "Net within the larger of 2 %% of cut + fill and its own interval: %d of %zu (largest error: %.2f of it).\n"
      "The bounds of the whole zone hold its true net: %d of %zu; their mean width is %.0f m3.\n",
      100.0 * seen / n, moved / n, within, cases.size(), worst, bounded, cases.size(), bounds / n);
}

}  // namespace
}  // namespace raywatch::evaluation

int main(int argc, char** argv) {
  using namespace raywatch::evaluation;
  CLI::App app("Measures volumes of simulated pits, surveyed from two stations on two nights, against the truth.",
               "raywatch-evaluate-volumes");
  std::size_t seeds = 1000;
  VolumeSurvey survey;
  app.add_option("--seeds", seeds, "How many pits")->check(CLI::Range(1, 1000000))->capture_default_str();
  app.add_option("--cell-m", survey.cell_m, "The cell of the elevation models")
      ->check(CLI::Range(0.25, 10.0))
      ->capture_default_str();
  app.add_option("--azimuth-steps", survey.azimuth_steps)->capture_default_str();
  app.add_option("--elevation-steps", survey.elevation_steps)->capture_default_str();
  app.add_option("--noise-m", survey.range_noise_m, "Of the ranges, one standard deviation")->capture_default_str();
  app.add_option("--position-m", survey.registration.position_sigma_m, "Registration error of each axis")
      ->capture_default_str();
  app.add_option("--angle-rad", survey.registration.angle_sigma_rad, "The same about each axis")->capture_default_str();
  app.add_option("--greatest-slope", survey.steepness.greatest_slope, "Stated of the ground; rise over run")
      ->check(CLI::Range(0.1, 100.0));
  CLI11_PARSE(app, argc, argv);
  std::vector<VolumeCase> cases(seeds);
  tbb::parallel_for(std::size_t{0}, seeds, [&](std::size_t i) { cases[i] = make_volume_case(i + 1, survey); });
  report(cases);
  return 0;
}
