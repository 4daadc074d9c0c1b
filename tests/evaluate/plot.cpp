#include "tests/evaluate/plot.hpp"

#include <cstdlib>
#include <fstream>
#include <functional>

#include "core/error.hpp"

namespace raywatch::evaluation {
namespace {

using Path = std::filesystem::path;

constexpr const char* kFScript = R"(set terminal svg size 900,500 background "white"
set output "f_score.svg"
set logscale x
set xlabel "T_r, m"
set ylabel "f"
set yrange [0:1]
set key outside
set multiplot layout 1,2
set title "single points"
plot for [i=0:*] "grid.dat" index i using 2:5 with linespoints title columnheader(1), \
     "consensus.dat" using 1:4 with points pointtype 7 pointsize 1.5 title "consensus"
set title "with clusters"
plot for [i=0:*] "grid.dat" index i using 2:8 with linespoints title columnheader(1), \
     "consensus.dat" using 1:7 with points pointtype 7 pointsize 1.5 title "consensus"
unset multiplot
)";

constexpr const char* kCurveScript = R"(set terminal svg size 900,500 background "white"
set output "precision_recall.svg"
set xlabel "recall"
set ylabel "precision"
set xrange [0:1]
set yrange [0:1.02]
set key outside
set multiplot layout 1,2
set title "single points"
plot for [i=0:*] "grid.dat" index i using 4:3 with linespoints title columnheader(1), \
     "consensus.dat" using 3:2 with points pointtype 7 pointsize 1.5 title "consensus"
set title "with clusters"
plot for [i=0:*] "grid.dat" index i using 7:6 with linespoints title columnheader(1), \
     "consensus.dat" using 6:5 with points pointtype 7 pointsize 1.5 title "consensus"
unset multiplot
)";

constexpr const char* kGridHead =
    "# T_a/spacing T_r_m precision recall f precision_clustered recall_clustered f_clustered\n";
constexpr const char* kConsensusHead = "# T_r_m precision recall f precision_clustered recall_clustered f_clustered\n";

void write_file(const Path& path, const std::function<void(std::ostream&)>& write) {
  std::ofstream out(path);
  write(out);
  out.close();
  if (!out) throw StorageError("cannot write " + path.string());
}

/// Several priors where there are any, else all pairs.
Tally plotted_tally(const Evaluation& evaluation, std::size_t setting) {
  Tally tally = evaluation.tally(Against::several, setting);
  if (tally.cases > 0) return tally;
  tally += evaluation.tally(Against::same_pose, setting);
  return tally += evaluation.tally(Against::other_pose, setting);
}

/// The best of the clusterings.
PointCounts clustered_points(const CaseScore& score) {
  PointCounts best;
  double best_f = -1.0;
  for (const CaseScore::Clustered& clustered : score.clustered) {
    const PointCounts points = clustered.points.both();
    if (points.f_score() <= best_f) continue;
    best_f = points.f_score();
    best = points;
  }
  return best;
}

void write_points(std::ostream& out, const CaseScore& score) {
  for (const PointCounts& points : {score.single.both(), clustered_points(score)}) {
    out << ' ' << points.precision() << ' ' << points.recall() << ' ' << points.f_score();
  }
  out << '\n';
}

/// One block for each T_a, with its name as the head of the first column.
void write_grid(const Evaluation& evaluation, std::ostream& out) {
  out << kGridHead;
  const std::vector<Setting>& settings = evaluation.settings();
  for (std::size_t s = Evaluation::kFirstOfGrid; s < settings.size(); ++s) {
    const double angle = *settings[s].angle_per_spacing;
    const bool first_of_block = s == Evaluation::kFirstOfGrid || *settings[s - 1].angle_per_spacing != angle;
    if (first_of_block && s > Evaluation::kFirstOfGrid) out << "\n\n";
    if (first_of_block) out << "\"T_a = " << angle << " x\" T_r p r f pc rc fc\n";
    out << angle << ' ' << settings[s].parameters.range_m;
    write_points(out, plotted_tally(evaluation, s).score);
  }
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

void write_plots(const Evaluation& evaluation, const Path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw StorageError("cannot create " + folder.string() + ": " + error.message());
  write_file(folder / "grid.dat", [&](std::ostream& out) { write_grid(evaluation, out); });
  write_file(folder / "consensus.dat", [&](std::ostream& out) {
    out << kConsensusHead << evaluation.settings()[Evaluation::kConsensus].parameters.range_m;
    write_points(out, plotted_tally(evaluation, Evaluation::kConsensus).score);
  });
  write_file(folder / "f_score.gp", [](std::ostream& out) { out << kFScript; });
  write_file(folder / "precision_recall.gp", [](std::ostream& out) { out << kCurveScript; });
}

bool draw_plots(const Path& folder) {
  const std::string command =
      "cd " + quoted(folder.string()) + " && gnuplot f_score.gp precision_recall.gp >/dev/null 2>&1";
  return std::system(command.c_str()) == 0;
}

}  // namespace raywatch::evaluation
