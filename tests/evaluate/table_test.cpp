#include "tests/evaluate/table.hpp"

#include <doctest/doctest.h>

#include <sstream>

using namespace raywatch;
using namespace raywatch::evaluation;

namespace {

TableRow some_row() {
  TableRow row{.data = "same pose", .method = "union best", .clusters = true};
  row.angle_per_spacing = 1.5;
  row.angle_rad = simulator::radians(0.75);
  row.range_m = 0.35;
  row.clustering = {0.4, 12};
  row.points.added = {.found = 3, .false_ = 1, .missed = 3, .unchanged = 9};
  row.points.removed = {.found = 1, .false_ = 0, .missed = 0, .unchanged = 9};
  row.in_sight.added = {.found = 3, .false_ = 1, .missed = 1, .unchanged = 9};
  row.in_sight.removed = row.points.removed;
  row.cases = 14;
  row.detect_ms = 24.4;
  row.points_per_s = 9.6e6;
  return row;
}

}  // namespace

TEST_CASE("a row of the table as Markdown") {
  std::ostringstream out;
  write_markdown(out, std::vector{some_row()});
  CHECK(out.str().find("| same pose | with | union best | 0.800 | 0.571 | 0.667 | 0.600 | 1.000 | 0.800 | 1.5 x "
                       "(0.75°) | 0.35 | 0.4 | 12 | 14 | 24 | 9.6 |\n") != std::string::npos);
}

TEST_CASE("without clusters the cells of the clusters stay empty, and chosen thresholds are called default") {
  TableRow row = some_row();
  row.clusters = false;
  row.angle_per_spacing = 0.0;
  std::ostringstream out;
  write_markdown(out, std::vector{row});
  CHECK(out.str().find("| default | 0.35 |  |  | 14 |") != std::string::npos);
}

TEST_CASE("a row of the table as CSV has as many fields as the head") {
  std::ostringstream out;
  write_csv(out, "lab", {some_row()});
  std::istringstream in(out.str());
  std::string head, line;
  std::getline(in, head);
  std::getline(in, line);
  CHECK(line.starts_with("lab,same pose,1,union best,1.5,0.750000,0.35,0.4,12,14,24.400,9600000,4,1,3,0.8"));
  CHECK(std::ranges::count(line, ',') == std::ranges::count(head, ','));
}
