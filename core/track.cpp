#include "core/track.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "core/names.hpp"

namespace raywatch {
namespace {

constexpr Names<TrackState, 3> kTrackStates{
    {{TrackState::open, "open"}, {TrackState::gone, "gone"}, {TrackState::accepted, "accepted"}}};
constexpr Names<Sight, 3> kSights{{{Sight::seen, "seen"}, {Sight::absent, "absent"}, {Sight::unseen, "unseen"}}};

/// How far the unseen rest of a thing may reach beyond what was seen of it.
double reach_m(const Eigen::AlignedBox3d& box) {
  return std::clamp(0.5 * std::max(box.sizes().x(), box.sizes().y()), 0.15, 1.0);
}

/// Fragments of one thing lie nearer together than this.
constexpr double kFragmentGap_m = 0.15;

/// How far two boxes are apart along the axis on which they are farthest apart; 0 or less when they overlap.
double gap_m(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  return (a.min() - b.max()).cwiseMax(b.min() - a.max()).maxCoeff();
}

bool may_belong_together(const Track& track, const Change& change) {
  return track.kind == change.kind && change.kind != ChangeKind::discrepancy &&
         gap_m(track.anchor_m, change.bounds_m) <= reach_m(track.anchor_m) + reach_m(change.bounds_m);
}

void remember(Track& track, bool seen, Time at) {
  track.recent = track.recent << 1 | (seen ? 1u : 0u);
  track.remembered = std::min(track.remembered + 1, kRememberedSights);
  ++(seen ? track.seen : track.absent);
  track.last_told_at = std::max(track.last_told_at, at);
  if (seen) {
    track.last_seen_at = std::max(track.last_seen_at, at);
    track.state = TrackState::open;
    track.ended_at.reset();
  }
}

struct Pair {
  double distance_m;
  std::size_t track, change;
  friend bool operator<(const Pair& a, const Pair& b) {
    return std::tie(a.distance_m, a.track, a.change) < std::tie(b.distance_m, b.track, b.change);
  }
};

std::vector<Pair> possible_pairs(std::span<const Track> tracks, std::span<const Change> changes) {
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    for (std::size_t c = 0; c < changes.size(); ++c) {
      if (!may_belong_together(tracks[t], changes[c])) continue;
      pairs.push_back({(tracks[t].latest.centroid_m - changes[c].centroid_m).norm(), t, c});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

std::string_view to_string(TrackState state) { return name_of(kTrackStates, state); }
TrackState parse_track_state(std::string_view name) { return value_of(kTrackStates, name, "state"); }
std::string_view to_string(Sight sight) { return name_of(kSights, sight); }

Track begin_track(const Change& change, std::vector<Eigen::Vector3f> sample_m, Time at) {
  Track track{
      .kind = change.kind, .anchor_m = change.bounds_m, .first_seen_at = at, .last_seen_at = at, .last_told_at = at};
  see(track, change, std::move(sample_m), at);
  return track;
}

void see(Track& track, const Change& change, std::vector<Eigen::Vector3f> sample_m, Time at) {
  track.latest = change;
  track.sample_m = std::move(sample_m);
  remember(track, true, at);
}

void see_still(Track& track, Time at) { remember(track, true, at); }

void miss(Track& track, Time at) {
  remember(track, false, at);
  if (track.state == TrackState::open) track.ended_at = at;
  track.state = TrackState::gone;
}

bool is_followed(const Track& track) {
  const bool just_ended = track.state == TrackState::gone && (track.recent & 0b11) == 0b10;
  return track.state == TrackState::open || just_ended;
}

std::uint32_t seen_of_last(const Track& track, std::uint32_t of) {
  const std::uint32_t count = std::min({of, track.remembered, kRememberedSights});
  const std::uint64_t mask = count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
  return static_cast<std::uint32_t>(std::popcount(track.recent & mask));
}

Sight sight_of(ChangeKind kind, std::span<const Answer> answers) {
  const auto count = [&](Answer wanted) { return std::count(answers.begin(), answers.end(), wanted); };
  const auto free = count(Answer::free), occupied = count(Answer::supported);
  const auto telling = free + occupied;
  if (telling < 3 || 5 * telling < static_cast<std::ptrdiff_t>(answers.size())) return Sight::unseen;
  const auto gone = kind == ChangeKind::removed ? occupied : free;
  if (5 * gone >= 3 * telling) return Sight::absent;
  if (5 * gone <= 2 * telling) return Sight::seen;
  return Sight::unseen;
}

std::vector<std::optional<std::size_t>> associate(std::span<const Track> tracks, std::span<const Change> changes) {
  std::vector<std::optional<std::size_t>> track_of(changes.size());
  std::vector<Eigen::AlignedBox3d> held_m(tracks.size());  // what each track has in this scan; empty: nothing
  const std::vector<Pair> pairs = possible_pairs(tracks, changes);
  for (const Pair& pair : pairs) {
    if (track_of[pair.change] || !held_m[pair.track].isEmpty()) continue;
    track_of[pair.change] = pair.track;
    held_m[pair.track] = tracks[pair.track].anchor_m.merged(changes[pair.change].bounds_m);
  }
  for (const Pair& pair : pairs) {
    if (track_of[pair.change] || held_m[pair.track].isEmpty()) continue;
    if (gap_m(held_m[pair.track], changes[pair.change].bounds_m) <= kFragmentGap_m) track_of[pair.change] = pair.track;
  }
  return track_of;
}

std::vector<std::vector<std::size_t>> group_fragments(std::span<const Change> changes,
                                                      std::span<const std::size_t> places) {
  std::vector<std::size_t> rest(places.begin(), places.end());
  std::stable_sort(rest.begin(), rest.end(),
                   [&](std::size_t a, std::size_t b) { return changes[a].points > changes[b].points; });
  std::vector<std::vector<std::size_t>> groups;
  while (!rest.empty()) {
    const Change& largest = changes[rest.front()];
    const auto others = std::stable_partition(rest.begin(), rest.end(), [&](std::size_t place) {
      return changes[place].kind == largest.kind && gap_m(changes[place].bounds_m, largest.bounds_m) <= kFragmentGap_m;
    });
    groups.emplace_back(rest.begin(), others);
    rest.erase(rest.begin(), others);
  }
  return groups;
}

double size_difference_m(const OrientedBox& a, const OrientedBox& b) { return (a.size_m - b.size_m).cwiseAbs().sum(); }

bool are_alike(const OrientedBox& a, const OrientedBox& b) {
  constexpr double kAgree_m = 0.15, kAgree = 0.3;
  const Eigen::Array3d difference_m = (a.size_m - b.size_m).array().abs();
  return (difference_m <= (kAgree * a.size_m.cwiseMax(b.size_m).array()).max(kAgree_m)).all();
}

}  // namespace raywatch
