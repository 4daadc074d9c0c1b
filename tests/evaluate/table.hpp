#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "tests/evaluate/evaluation.hpp"

namespace raywatch::evaluation {

/// One line of the layout of Table II of Underwood et al. 2013, and what the project adds to it.
struct TableRow {
  std::string data;    ///< "single pairs", "same pose", "other pose" or "several priors"
  std::string method;  ///< "union best", "union" or "consensus"
  bool clusters = false;
  double angle_per_spacing = 0.0;  ///< T_a; 0: chosen by the program for each prior
  double angle_rad = 0.0;          ///< the same, at the places' mean spacing; 0 likewise
  double range_m = 0.0;            ///< T_r
  Clustering clustering;
  Counts points;
  Counts in_sight;      ///< without the changed points that no scan could see
  ObjectScore objects;  ///< only with clusters
  std::size_t cases = 0;
  double detect_ms = 0.0;     ///< of one comparison
  double points_per_s = 0.0;  ///< asked points
};

/// What was found as objects. Also where nothing changed.
struct ObjectRow {
  std::string data;
  std::string method;
  ObjectScore score;
};

std::vector<TableRow> table_rows(const Evaluation& evaluation);
std::vector<ObjectRow> object_rows(const Evaluation& evaluation);

void write_markdown(std::ostream& out, const std::vector<TableRow>& rows);
void write_markdown(std::ostream& out, const std::vector<ObjectRow>& rows);
/// One line a row, with the counts behind the numbers.
void write_csv(std::ostream& out, const std::string& name, const std::vector<TableRow>& rows);

}  // namespace raywatch::evaluation
