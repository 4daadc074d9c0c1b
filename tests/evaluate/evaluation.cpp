#include "tests/evaluate/evaluation.hpp"

#include <algorithm>
#include <numbers>

namespace raywatch::evaluation {
namespace {

Clustering clustering_of(const CompareParameters& parameters) {
  return {parameters.cluster_distance_m, parameters.cluster_min_points};
}

/// The published cluster distance is made for rooms. Where shots are farther apart, `union` would find nothing with it:
/// it may also take what the profile takes, so that it is not beaten for that alone.
std::vector<Clustering> clusterings_of_grid(Profile profile) {
  std::vector<Clustering> clusterings{clustering_of(default_parameters(profile, Grouping::union_))};
  const Clustering weighed = clustering_of(default_parameters(profile, Grouping::consensus));
  if (weighed != clusterings.front()) clusterings.push_back(weighed);
  return clusterings;
}

std::vector<Setting> settings_for(const Evaluation::Options& options) {
  std::vector<Setting> settings;
  for (const Grouping grouping : {Grouping::consensus, Grouping::union_}) {
    const CompareParameters parameters = default_parameters(options.profile, grouping);
    settings.push_back({parameters, std::nullopt, {clustering_of(parameters)}});
  }
  for (const double angle : options.grid.angle_per_spacing) {
    for (const double range_m : options.grid.range_m) {
      CompareParameters parameters = default_parameters(options.profile, Grouping::union_);
      parameters.range_m = range_m;
      settings.push_back({parameters, angle, clusterings_of_grid(options.profile)});
    }
  }
  return settings;
}

std::size_t points_asked(const CaseLabels& labels) {
  std::size_t points = labels.scan->labels.size() * labels.priors.size();
  for (const SimulatedScan* prior : labels.priors) points += prior->labels.size();
  return points;
}

}  // namespace

Tally& Tally::operator+=(const Tally& other) {
  score += other.score;
  cases += other.cases;
  detect_ms += other.detect_ms;
  asked += other.asked;
  return *this;
}

Evaluation::Evaluation(Options options) : options_(std::move(options)), settings_(settings_for(options_)) {
  for (std::vector<Tally>& of_kind : tallies_) of_kind.resize(settings_.size());
}

void Evaluation::add(const IndexedPlace& place) {
  spacing_sum_rad_ += place.spacing_rad();
  ++places_;
  const Duration contemporary = contemporary_tolerance(options_.profile);
  for (const Case& c : make_cases(place.place(), contemporary, options_.most_pairs)) {
    const CaseLabels labels = labels_of(place, c);
    // What is found where nothing changed is told for the defaults only: no threshold is chosen by it.
    const std::size_t settings = c.against == Against::quiet ? kFirstOfGrid : settings_.size();
    for (std::size_t s = 0; s < settings; ++s) {
      CompareParameters parameters = settings_[s].parameters;
      if (const auto multiple = settings_[s].angle_per_spacing) {
        parameters.angle_rad = std::min(*multiple * place.spacing_rad(), std::numbers::pi / 2);
      }
      const TimedScore timed = score_case(place, c, labels, parameters, settings_[s].clusterings);
      tallies_[static_cast<std::size_t>(c.against)][s] +=
          Tally{.score = timed.score, .cases = 1, .detect_ms = timed.detect_ms, .asked = points_asked(labels)};
    }
  }
}

double Evaluation::spacing_rad() const { return places_ == 0 ? 0.0 : spacing_sum_rad_ / static_cast<double>(places_); }

}  // namespace raywatch::evaluation
