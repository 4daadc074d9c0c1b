/// Watches simulated nights and compares the alerts with what really happened.

#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

#include "tests/evaluate/nights.hpp"

namespace raywatch::evaluation {
namespace {

void report(const NightsResult& result) {
  std::printf("| happened | at | alerts |\n| --- | --- | ---: |\n");
  for (const Planted& thing : result.planted) {
    const char* what = thing.kind == ChangeKind::added ? "left" : "taken";
    std::printf("| %s %s | %s | %zu |\n", thing.name.c_str(), what, format_rfc3339(thing.at).c_str(), thing.alerts);
  }
  std::printf(
      "\n%zu scans, in which somebody passed %zu times. Of %zu things that were left or taken for good, %zu were "
      "alerted once, %zu never, %zu more than once.\nFalse alerts: %zu.\n",
      result.scans, result.passers, result.planted.size(), result.told(1), result.told(0),
      result.planted.size() - result.told(0) - result.told(1), result.false_alerts.size());
  for (const FalseAlert& alert : result.false_alerts) {
    std::printf("- %s: %s", format_rfc3339(alert.at).c_str(), alert.title.c_str());
    const Eigen::Vector3d low_m = alert.box_m.min(), high_m = alert.box_m.max();
    if (!alert.box_m.isEmpty()) {
      std::printf(" From (%.2f, %.2f, %.2f) to (%.2f, %.2f, %.2f) m.", low_m.x(), low_m.y(), low_m.z(), high_m.x(),
                  high_m.y(), high_m.z());
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace raywatch::evaluation

int main(int argc, char** argv) {
  using namespace raywatch::evaluation;
  CLI::App app("Watches a simulated yard for many nights and compares the alerts with what really happened.",
               "raywatch-evaluate-nights");
  NightsOptions options;
  app.add_option("--seed", options.seed, "Another seed is another yard")->capture_default_str();
  app.add_flag("--hard", options.hard, "More clutter, and sensors that are 1 cm and 0.05 degrees off");
  app.add_option("--density", options.density, "Shots in relation to 64 rings of 1800")
      ->check(CLI::Range(0.05, 10.0))
      ->capture_default_str();
  app.add_option("--scans", options.scans, "Of two sensors together")
      ->check(CLI::Range(20U, 60'000U))
      ->capture_default_str();
  app.add_option("--rounds-apart", options.rounds_apart, "Something lasting happens every so many rounds")
      ->check(CLI::Range(4U, 10'000U))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  spdlog::set_level(spdlog::level::err);
  try {
    report(watch_nights(options, [&](std::size_t scans) {
      if (scans % 20 == 0) std::fprintf(stderr, "\r%zu of %u scans", scans, options.scans);
    }));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "raywatch-evaluate-nights: %s\n", error.what());
    return 1;
  }
  return 0;
}
