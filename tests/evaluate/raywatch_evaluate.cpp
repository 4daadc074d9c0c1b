/// Scores the detector on labelled scans and prints the result as a table.

#include <oneapi/tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "core/error.hpp"
#include "tests/evaluate/error_study.hpp"
#include "tests/evaluate/plot.hpp"
#include "tests/evaluate/table.hpp"

namespace raywatch::evaluation {
namespace {

constexpr const char* kDescription =
    "Scores the detector on labelled scans: the layout of Table II of Underwood et al. 2013, and objects.\n\n"
    "Give folders as raywatch-simulate writes them, or a family, whose places are then made in memory.";

constexpr const char* kFooter =
    "Examples:\n"
    "  raywatch-evaluate --family lab --seed 1..4 --hard\n"
    "  raywatch-evaluate --profile outdoor my-scans/ --csv table.csv";

struct Arguments {
  std::vector<std::string> folders;
  std::string family;
  std::string seeds = "1";
  bool hard = false;
  double density = 1.0;
  std::uint32_t scans = 0;
  std::string profile;
  bool defaults_only = false;
  Grid grid;
  std::size_t pairs = 24;
  std::string csv;
  std::string plots;
  std::string pictures;
  std::string objects;
  int threads = 0;
};

void declare(CLI::App& app, Arguments& arguments) {
  app.footer(kFooter);
  app.add_option("folder", arguments.folders, "Folders of labelled scans, one place each");
  app.add_option("--family", arguments.family, "Simulate places of this family instead: sim, lab, carpark, yard, mine");
  app.add_option("--seed", arguments.seeds, "Which places of the family: N or FIRST..LAST")->capture_default_str();
  app.add_flag("--hard", arguments.hard, "The family's hard variant: registration errors, more clutter");
  app.add_option("--density", arguments.density, "Shots in relation to the family's usual scanner")
      ->check(CLI::Range(1e-4, 100.0))
      ->capture_default_str();
  app.add_option("--scans", arguments.scans, "Scans of each place; not given: as the family's story needs");
  app.add_option("--profile", arguments.profile,
                 "indoor, outdoor or survey; not given: as suits the family, for folders indoor");
  app.add_flag("--defaults-only", arguments.defaults_only, "Do not look for the best thresholds of union");
  app.add_option("--angles", arguments.grid.angle_per_spacing,
                 "The grid's T_a, as multiples of the spacing of the shots")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--ranges", arguments.grid.range_m, "The grid's T_r in metres")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--pairs", arguments.pairs, "Single pairs that are compared of each place, at most")
      ->capture_default_str();
  app.add_option("--csv", arguments.csv, "Write the table to this file, too");
  app.add_option("--plot", arguments.plots,
                 "Write plots of the grid into this folder: data, gnuplot scripts, and SVG when gnuplot is there");
  app.add_option("--pictures", arguments.pictures,
                 "Write a picture of each kind of error that consensus makes into this folder");
  app.add_option("--objects", arguments.objects,
                 "Write what consensus made of every real change, and every false one, to this CSV file");
  app.add_option("--threads", arguments.threads, "Threads; 0: as many as there are cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

struct SeedRange {
  std::uint64_t first = 1;
  std::uint64_t last = 1;
};

SeedRange parse_seeds(const std::string& text) {
  const std::size_t dots = text.find("..");
  try {
    std::size_t used = 0;
    SeedRange range;
    range.first = range.last = std::stoull(text, &used);
    if (used != std::min(dots, text.size())) throw std::invalid_argument(text);
    if (dots != std::string::npos) {
      range.last = std::stoull(text.substr(dots + 2), &used);
      if (dots + 2 + used != text.size()) throw std::invalid_argument(text);
    }
    if (range.last >= range.first) return range;
  } catch (const std::logic_error&) {
  }
  throw InvalidInput("--seed: \"" + text + "\" is neither a number nor FIRST..LAST");
}

Evaluation::Options options_of(const Arguments& arguments) {
  Evaluation::Options options;
  if (!arguments.profile.empty()) {
    options.profile = parse_profile(arguments.profile);
  } else if (!arguments.family.empty()) {
    options.profile = profile_of(simulator::parse_family(arguments.family));
  }
  options.grid = arguments.defaults_only ? Grid{{}, {}} : arguments.grid;
  options.most_pairs = arguments.pairs;
  return options;
}

void add_places(const Arguments& arguments, Evaluation& evaluation, ErrorStudy& errors) {
  const CompareParameters consensus = default_parameters(evaluation.options().profile, Grouping::consensus);
  const auto add = [&](const Place& place) {
    std::cerr << place.name << ": " << place.scans.size() << " scans" << std::endl;
    const IndexedPlace indexed(place, evaluation.options().profile);
    evaluation.add(indexed);
    errors.add(indexed, consensus);
  };
  for (const std::string& folder : arguments.folders) add(read_place(folder));
  if (arguments.family.empty()) return;
  const simulator::Family family = simulator::parse_family(arguments.family);
  const SeedRange seeds = parse_seeds(arguments.seeds);
  for (std::uint64_t seed = seeds.first; seed <= seeds.last; ++seed) {
    simulator::FamilyOptions options{.seed = seed, .hard = arguments.hard, .density = arguments.density};
    if (arguments.scans > 0) options.scans = arguments.scans;
    add(simulate_place(family, options));
  }
}

void plot(const Evaluation& evaluation, const std::string& folder) {
  write_plots(evaluation, folder);
  if (!draw_plots(folder)) {
    std::cerr << "gnuplot is not there or failed: " << folder
              << " holds data and scripts, but no SVG (Debian: gnuplot-nox)" << std::endl;
  }
}

std::string title_of(const Arguments& arguments) {
  if (arguments.family.empty()) return arguments.folders.front();
  return arguments.family + (arguments.hard ? " hard" : "");
}

template <class Write>
void write_file(const std::string& path, Write write) {
  std::ofstream out(path);
  write(out);
  out.close();
  if (!out) throw StorageError("cannot write " + path);
}

void run(const Arguments& arguments) {
  if (arguments.family.empty() == arguments.folders.empty()) {
    throw InvalidInput("give either folders of labelled scans or --family");
  }
  if (!arguments.plots.empty() && arguments.defaults_only) {
    throw InvalidInput("--plot shows the grid, which --defaults-only leaves out");
  }
  Evaluation evaluation(options_of(arguments));
  tbb::task_arena arena(arguments.threads > 0 ? arguments.threads : tbb::task_arena::automatic);
  ErrorStudy errors;
  arena.execute([&] { add_places(arguments, evaluation, errors); });
  const std::vector<TableRow> rows = table_rows(evaluation);
  if (rows.empty()) {
    throw InvalidInput("no scan has an earlier one of another state, older than the profile's contemporary tolerance");
  }
  std::cout << "Points:\n\n";
  write_markdown(std::cout, rows);
  std::cout << "\nObjects, with clusters:\n\n";
  write_markdown(std::cout, object_rows(evaluation));
  std::cout << "\nErrors of consensus at the defaults, against several priors, with clusters:\n\n";
  errors.causes.write_markdown(std::cout);
  if (!arguments.plots.empty()) plot(evaluation, arguments.plots);
  if (!arguments.pictures.empty()) errors.gallery.write(arguments.pictures);
  if (!arguments.objects.empty()) {
    write_file(arguments.objects, [&](std::ostream& out) { out << errors.objects.view(); });
  }
  if (!arguments.csv.empty()) {
    write_file(arguments.csv, [&](std::ostream& out) { write_csv(out, title_of(arguments), rows); });
  }
}

}  // namespace
}  // namespace raywatch::evaluation

int main(int argc, char** argv) {
  using namespace raywatch::evaluation;
  CLI::App app(kDescription, "raywatch-evaluate");
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "raywatch-evaluate: %s\n", error.what());
    return 1;
  }
  return 0;
}
