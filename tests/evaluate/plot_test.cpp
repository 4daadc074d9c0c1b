#include "tests/evaluate/plot.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "tests/support/temp_dir.hpp"

using namespace raywatch;
using namespace raywatch::evaluation;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("plots have a block for each T_a and a line for each T_r, and scripts that read them") {
  const Place place = simulate_place(simulator::Family::sim, {.seed = 3, .density = 0.02, .scans = 5});
  Evaluation evaluation({.profile = Profile::outdoor, .grid = {{1.0, 2.0}, {0.1, 0.5, 1.0}}, .most_pairs = 2});
  evaluation.add(IndexedPlace(place, Profile::outdoor));
  const TempDir scratch;
  write_plots(evaluation, scratch / "plots");
  const std::string grid = text_of(scratch / "plots" / "grid.dat");
  CHECK(grid.find("\"T_a = 1 x\"") < grid.find("\n1 0.1 "));
  CHECK(grid.find("\n1 1 ") < grid.find("\n\n\n\"T_a = 2 x\""));
  CHECK(grid.find("\n2 0.5 ") != std::string::npos);
  for (const char* script : {"f_score.gp", "precision_recall.gp"}) {
    CHECK(text_of(scratch / "plots" / script).find("\"grid.dat\"") != std::string::npos);
  }
  std::ostringstream consensus;
  consensus << '\n' << default_parameters(Profile::outdoor, Grouping::consensus).range_m << ' ';
  CHECK(text_of(scratch / "plots" / "consensus.dat").find(consensus.str()) != std::string::npos);
}
