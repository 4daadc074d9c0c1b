#include "tests/evaluate/table.hpp"

#include <cstdio>
#include <numbers>
#include <span>

namespace raywatch::evaluation {
namespace {

struct Data {
  const char* name;
  std::vector<Against> kinds;
};

const std::vector<Data>& all_data() {
  static const std::vector<Data> data{{"single pairs", {Against::same_pose, Against::other_pose}},
                                      {"same pose", {Against::same_pose}},
                                      {"other pose", {Against::other_pose}},
                                      {"several priors", {Against::several}}};
  return data;
}

Tally tally_of(const Evaluation& evaluation, const Data& data, std::size_t setting) {
  Tally sum;
  for (const Against kind : data.kinds) sum += evaluation.tally(kind, setting);
  return sum;
}

/// A setting and one of its clusterings, or none.
struct Choice {
  std::size_t setting = 0;
  std::optional<std::size_t> clustering;
};

const Counts& points_of(const Tally& tally, const Choice& choice) {
  return choice.clustering ? tally.score.clustered[*choice.clustering].points : tally.score.single;
}

const Counts& in_sight_of(const Tally& tally, const Choice& choice) {
  return choice.clustering ? tally.score.clustered[*choice.clustering].in_sight : tally.score.single_in_sight;
}

/// The thresholds of the grid that have the highest f-score over the data; the first of equals.
std::optional<Choice> best_choice(const Evaluation& evaluation, const Data& data, bool clusters) {
  std::optional<Choice> best;
  double best_f = -1.0;
  for (std::size_t s = Evaluation::kFirstOfGrid; s < evaluation.settings().size(); ++s) {
    const Tally tally = tally_of(evaluation, data, s);
    if (tally.cases == 0) return std::nullopt;
    const std::size_t variants = clusters ? tally.score.clustered.size() : 1;
    for (std::size_t k = 0; k < variants; ++k) {
      const Choice choice{s, clusters ? std::optional(k) : std::nullopt};
      const double f = points_of(tally, choice).both().f_score();
      if (f <= best_f) continue;
      best_f = f;
      best = choice;
    }
  }
  return best;
}

TableRow make_row(const Evaluation& evaluation, const Data& data, const char* method, const Choice& choice) {
  const Setting& setting = evaluation.settings()[choice.setting];
  const Tally tally = tally_of(evaluation, data, choice.setting);
  TableRow row{.data = data.name, .method = method, .clusters = choice.clustering.has_value()};
  row.angle_per_spacing = setting.angle_per_spacing.value_or(0.0);
  row.angle_rad = row.angle_per_spacing * evaluation.spacing_rad();
  row.range_m = setting.parameters.range_m;
  if (choice.clustering) {
    row.clustering = setting.clusterings[*choice.clustering];
    row.objects = tally.score.clustered[*choice.clustering].objects;
  }
  row.points = points_of(tally, choice);
  row.in_sight = in_sight_of(tally, choice);
  row.cases = tally.cases;
  row.detect_ms = tally.detect_ms / static_cast<double>(tally.cases);
  row.points_per_s = static_cast<double>(tally.asked) / (1e-3 * tally.detect_ms);
  return row;
}

std::string text(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

std::string angle_text(const TableRow& row) {
  if (row.angle_per_spacing == 0.0) return "default";
  return text("%g", row.angle_per_spacing) + " x (" + text("%.2f", degrees(row.angle_rad)) + "°)";
}

void write_cells(std::ostream& out, std::span<const std::string> cells) {
  for (const std::string& cell : cells) out << "| " << cell << ' ';
  out << "|\n";
}

void write_head(std::ostream& out, std::span<const std::string> names, std::size_t text_columns) {
  write_cells(out, names);
  for (std::size_t i = 0; i < names.size(); ++i) out << (i < text_columns ? "| --- " : "| ---: ");
  out << "|\n";
}

ObjectRow object_row(const Evaluation& evaluation, const Data& data, const char* method, const Choice& choice) {
  const Tally tally = tally_of(evaluation, data, choice.setting);
  return {data.name, method, tally.score.clustered[*choice.clustering].objects};
}

}  // namespace

std::vector<TableRow> table_rows(const Evaluation& evaluation) {
  std::vector<TableRow> rows;
  for (const Data& data : all_data()) {
    for (const bool clusters : {false, true}) {
      const auto clustering = clusters ? std::optional<std::size_t>(0) : std::nullopt;
      if (tally_of(evaluation, data, Evaluation::kConsensus).cases == 0) continue;
      if (const auto best = best_choice(evaluation, data, clusters)) {
        rows.push_back(make_row(evaluation, data, "union best", *best));
      }
      rows.push_back(make_row(evaluation, data, "union", {Evaluation::kPublished, clustering}));
      rows.push_back(make_row(evaluation, data, "consensus", {Evaluation::kConsensus, clustering}));
    }
  }
  return rows;
}

std::vector<ObjectRow> object_rows(const Evaluation& evaluation) {
  const Data& several = all_data().back();
  const Data quiet{"nothing changed", {Against::quiet}};
  std::vector<ObjectRow> rows;
  if (tally_of(evaluation, several, Evaluation::kConsensus).cases > 0) {
    if (const auto best = best_choice(evaluation, several, true)) {
      rows.push_back(object_row(evaluation, several, "union best", *best));
    }
    rows.push_back(object_row(evaluation, several, "union", {Evaluation::kPublished, 0}));
    rows.push_back(object_row(evaluation, several, "consensus", {Evaluation::kConsensus, 0}));
  }
  if (tally_of(evaluation, quiet, Evaluation::kConsensus).cases > 0) {
    rows.push_back(object_row(evaluation, quiet, "union", {Evaluation::kPublished, 0}));
    rows.push_back(object_row(evaluation, quiet, "consensus", {Evaluation::kConsensus, 0}));
  }
  return rows;
}

void write_markdown(std::ostream& out, const std::vector<TableRow>& rows) {
  const std::vector<std::string> names{"data",      "clusters",        "method", "precision", "recall", "f", "f added",
                                       "f removed", "f in sight",      "T_a",    "T_r, m",    "d, m",   "m", "compared",
                                       "ms",        "million points/s"};
  write_head(out, names, 3);
  for (const TableRow& row : rows) {
    const PointCounts both = row.points.both();
    const std::vector<std::string> cells{row.data,
                                         row.clusters ? "with" : "without",
                                         row.method,
                                         text("%.3f", both.precision()),
                                         text("%.3f", both.recall()),
                                         text("%.3f", both.f_score()),
                                         text("%.3f", row.points.added.f_score()),
                                         text("%.3f", row.points.removed.f_score()),
                                         text("%.3f", row.in_sight.both().f_score()),
                                         angle_text(row),
                                         text("%g", row.range_m),
                                         row.clusters ? text("%g", row.clustering.distance_m) : "",
                                         row.clusters ? std::to_string(row.clustering.min_points) : "",
                                         std::to_string(row.cases),
                                         text("%.0f", row.detect_ms),
                                         text("%.1f", 1e-6 * row.points_per_s)};
    write_cells(out, cells);
  }
}

void write_markdown(std::ostream& out, const std::vector<ObjectRow>& rows) {
  const std::vector<std::string> names{"data",
                                       "method",
                                       "real",
                                       "found",
                                       "as exactly one",
                                       "split",
                                       "merged",
                                       "scans",
                                       "false added per scan",
                                       "false removed per scan",
                                       "undecided"};
  write_head(out, names, 2);
  for (const ObjectRow& row : rows) {
    const ObjectCounts both = row.score.both();
    const auto scans = static_cast<double>(row.score.comparisons);
    const std::vector<std::string> cells{row.data,
                                         row.method,
                                         std::to_string(both.real),
                                         std::to_string(both.found),
                                         std::to_string(both.once),
                                         std::to_string(both.split),
                                         std::to_string(both.merged),
                                         std::to_string(row.score.comparisons),
                                         text("%.2f", static_cast<double>(row.score.added.false_) / scans),
                                         text("%.2f", static_cast<double>(row.score.removed.false_) / scans),
                                         std::to_string(both.undecided)};
    write_cells(out, cells);
  }
}

namespace {

void write_counts(std::ostream& out, const PointCounts& counts) {
  out << ',' << counts.found << ',' << counts.false_ << ',' << counts.missed << ',' << text("%.6f", counts.precision())
      << ',' << text("%.6f", counts.recall()) << ',' << text("%.6f", counts.f_score());
}

}  // namespace

void write_csv(std::ostream& out, const std::string& name, const std::vector<TableRow>& rows) {
  out << "name,data,clusters,method,angle_per_spacing,angle_deg,range_m,cluster_distance_m,cluster_min_points,compared,"
         "detect_ms,points_per_s";
  for (const char* direction : {"both", "added", "removed"}) {
    for (const char* column : {"found", "false", "missed", "precision", "recall", "f"}) {
      out << ',' << direction << '_' << column;
    }
  }
  out << ",in_sight_f";
  for (const char* column : {"real", "found", "once", "split", "merged", "false", "undecided"})
    out << ",objects_" << column;
  out << '\n';
  for (const TableRow& row : rows) {
    out << name << ',' << row.data << ',' << (row.clusters ? 1 : 0) << ',' << row.method << ',' << row.angle_per_spacing
        << ',' << text("%.6f", degrees(row.angle_rad)) << ',' << row.range_m << ',' << row.clustering.distance_m << ','
        << row.clustering.min_points << ',' << row.cases << ',' << text("%.3f", row.detect_ms) << ','
        << text("%.0f", row.points_per_s);
    write_counts(out, row.points.both());
    write_counts(out, row.points.added);
    write_counts(out, row.points.removed);
    out << ',' << text("%.6f", row.in_sight.both().f_score());
    const ObjectCounts objects = row.objects.both();
    for (const std::size_t count : {objects.real, objects.found, objects.once, objects.split, objects.merged,
                                    objects.false_, objects.undecided}) {
      out << ',' << count;
    }
    out << '\n';
  }
}

}  // namespace raywatch::evaluation
