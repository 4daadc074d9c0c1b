/// Writes the scans of a simulated place, with their truth, into a folder.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>

#include "core/error.hpp"
#include "tests/simulator/scene_folder.hpp"

namespace raywatch::simulator {
namespace {

constexpr const char* kDescription =
    "Writes the scans of a simulated place, with their truth, into a folder.\n\n"
    "Families:\n"
    "  sim      a room of 100 m, boxes come and go; four poses, grid of 1 degree, no noise\n"
    "  lab      a box of 14 x 17 x 40 cm moves in a cluttered room; three poses, 64 rings, 2 cm noise\n"
    "  carpark  cars are moved, leave and arrive; three poses, 64 rings\n"
    "  yard     a bag is left, a crate removed, a person passes; two fixed sensors, 64 rings\n"
    "  mine     a bench is blasted and dug away; two stations of a tripod scanner, 1.4 million shots, a night apart\n"
    "  pit      the same pit from the wall opposite, a week of nights, two light scanners, true heights in the "
    "manifest\n"
    "  stream   the yard with one sensor, ending now, at first without any change; for demonstrations\n\n"
    "The same options always give the same bytes (stream: the same with --start).";

constexpr const char* kFooter =
    "For each scan: NAME.pcd (sensor frame), NAME.pcd.json (side-car) and NAME.pcd.labels (\"RWLB\", u32 version 1,\n"
    "u64 n, n x u16 state ids, little endian). manifest.json lists scans, poses and states. A point with label L is\n"
    "truly changed with respect to another scan if L is neither 0 nor 65535 and not among that scan's present "
    "states.\n\n"
    "Example: raywatch-simulate lab --output /tmp/lab --seed 7 --hard";

struct Arguments {
  std::string family;
  std::string output;
  std::string format = "pcd";
  std::string start;
  double interval_s = 0.0;
  std::uint32_t scans = 0;
  FamilyOptions options;
};

void declare(CLI::App& app, Arguments& arguments) {
  std::vector<std::string> families;
  for (const Family family : kFamilies) families.emplace_back(to_string(family));
  app.footer(kFooter);
  app.add_option("family", arguments.family, "What to simulate")->required()->check(CLI::IsMember(families));
  app.add_option("-o,--output", arguments.output, "Folder to write to; created if needed")->required();
  app.add_option("--seed", arguments.options.seed, "Another seed is another place of the family")
      ->capture_default_str();
  app.add_flag("--hard", arguments.options.hard, "More clutter, registration error of 1 cm and 0.05 degrees per axis");
  app.add_option("--scans", arguments.scans, "Number of scans; not given: as the family's story needs")
      ->check(CLI::Range(1U, 65535U));
  app.add_option("--density", arguments.options.density, "Shots in relation to the family's usual scanner")
      ->check(CLI::Range(1e-4, 100.0))
      ->capture_default_str();
  app.add_option("--start", arguments.start, "Capture time of the first scan, RFC 3339");
  app.add_option("--interval-s", arguments.interval_s,
                 "Seconds between scans (sim, lab, carpark, mine, pit: of one epoch; yard, stream: of one sensor)")
      ->check(CLI::Range(0.001, 1e7));
  app.add_option("--format", arguments.format, "Format of the scan files")
      ->check(CLI::IsMember({"pcd"}))
      ->capture_default_str();
}

/// Moves the story so that its last scan is taken now.
void end_now(Timeline& timeline) {
  if (timeline.moments.empty()) return;
  const Time now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  const Duration shift = now - timeline.moments.back().plan.captured_at;
  for (Moment& moment : timeline.moments) moment.plan.captured_at += shift;
}

std::string numbered(const std::string& name, std::size_t number) {
  std::string digits = std::to_string(number);
  return name + "_" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

void run(Arguments& arguments) {
  FamilyOptions& options = arguments.options;
  if (arguments.scans > 0) options.scans = arguments.scans;
  if (!arguments.start.empty()) options.start = parse_rfc3339(arguments.start);
  if (arguments.interval_s > 0.0) {
    options.interval = std::chrono::round<Duration>(std::chrono::duration<double>(arguments.interval_s));
  }
  const Family family = parse_family(arguments.family);
  Timeline timeline = make_timeline(family, options);
  if (family == Family::stream && !options.start) end_now(timeline);

  SceneFolder folder(arguments.output);
  for (std::size_t i = 0; i < timeline.moments.size(); ++i) {
    const SimulatedScan scan = take_scan(timeline, timeline.moments[i]);
    const std::string file = folder.add(numbered(arguments.family, i), scan);
    std::cout << file << "  " << format_rfc3339(scan.captured_at) << "  " << scan.sensor << "  " << scan.points.size()
              << " points" << std::endl;
  }
  folder.write_manifest(family, options, timeline);
}

}  // namespace
}  // namespace raywatch::simulator

int main(int argc, char** argv) {
  using namespace raywatch::simulator;
  CLI::App app(kDescription, "raywatch-simulate");
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "raywatch-simulate: %s\n", error.what());
    return 1;
  }
  return 0;
}
