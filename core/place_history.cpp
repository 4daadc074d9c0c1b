#include "core/place_history.hpp"

#include <algorithm>

#include "core/names.hpp"
#include "core/question.hpp"

namespace raywatch {
namespace {

constexpr Names<Presence, 3> kPresences{
    {{Presence::free, "free"}, {Presence::occupied, "occupied"}, {Presence::not_seen, "not_seen"}}};

PlaceInterval begin_interval(const PlaceSight& sight) {
  return {.presence = sight.presence,
          .first_scan = sight.scan,
          .last_scan = sight.scan,
          .from = sight.at,
          .to = sight.at,
          .scans = 1};
}

void extend(PlaceInterval& interval, const PlaceSight& sight) {
  interval.last_scan = sight.scan;
  interval.to = sight.at;
  ++interval.scans;
}

}  // namespace

std::string_view to_string(Presence presence) { return name_of(kPresences, presence); }

Answer ask_returns(std::span<const PointCloud> returns, const UsableRange& usable, const Eigen::Vector3d& place_m,
                   const Thresholds& thresholds) {
  const Question question(place_m.x(), place_m.y(), place_m.z(), SquaredThresholds(thresholds));
  if (!is_usable(question.range_m(), usable)) return Answer::unseen;
  Evidence evidence;
  for (const PointCloud& cloud : returns) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double x = cloud.x_m[i], y = cloud.y_m[i], z = cloud.z_m[i];
      if (!question.in_cone(x, y, z, x * x + y * y + z * z)) continue;
      if (is_usable(std::sqrt(x * x + y * y + z * z), usable)) evidence.look_at(question, x, y, z);
    }
  }
  return evidence.answer();
}

Presence presence_of(std::span<const Answer> answers) {
  const auto count = [&](Answer wanted) { return std::count(answers.begin(), answers.end(), wanted); };
  if (count(Answer::supported) > 0) return Presence::occupied;
  const auto free = count(Answer::free);
  return free > 0 && 2 * free >= static_cast<std::ptrdiff_t>(answers.size()) ? Presence::free : Presence::not_seen;
}

std::vector<PlaceInterval> intervals_of(std::span<const PlaceSight> sights) {
  std::vector<PlaceInterval> intervals;
  for (const PlaceSight& sight : sights) {
    if (!intervals.empty() && intervals.back().presence == sight.presence) {
      extend(intervals.back(), sight);
      continue;
    }
    // What was not seen between two sights of the same is part of one interval.
    const bool resumes = intervals.size() >= 2 && intervals.back().presence == Presence::not_seen &&
                         intervals[intervals.size() - 2].presence == sight.presence;
    if (resumes) {
      const std::uint64_t missed = intervals.back().scans;
      intervals.pop_back();
      intervals.back().not_seen += missed;
      extend(intervals.back(), sight);
    } else {
      intervals.push_back(begin_interval(sight));
    }
  }
  return intervals;
}

}  // namespace raywatch
