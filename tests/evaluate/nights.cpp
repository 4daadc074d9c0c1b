#include "tests/evaluate/nights.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "tests/server/watched_site.hpp"
#include "tests/simulator/story.hpp"

namespace raywatch::evaluation {
namespace {

using simulator::Moment;
using simulator::StateId;
using simulator::Timeline;

Timeline nights_timeline(const NightsOptions& options) {
  constexpr std::uint32_t kSensors = 2, kQuietRounds = 5;
  return simulator::yard_timeline({.seed = options.seed,
                                   .hard = options.hard,
                                   .density = options.density,
                                   .scans = options.scans,
                                   .interval = std::chrono::minutes(10)},
                                  {.sensors = kSensors,
                                   .quiet_rounds = kQuietRounds,
                                   .rounds = options.scans / kSensors,
                                   .rounds_apart = options.rounds_apart});
}

/// When a state was there.
struct Stay {
  Time from, until;
};

std::map<StateId, Stay> stays_of(const Timeline& timeline) {
  std::map<StateId, Stay> stays;
  for (const Moment& moment : timeline.moments) {
    for (const StateId id : moment.present) {
      stays.try_emplace(id, Stay{moment.plan.captured_at, {}}).first->second.until = moment.plan.captured_at;
    }
  }
  return stays;
}

/// What was planted, with the box that it has.
struct Expected {
  Planted planted;
  Eigen::AlignedBox3d box_m;
};

class Truth {
 public:
  explicit Truth(const Timeline& timeline) {
    const Time first = timeline.moments.front().plan.captured_at, last = timeline.moments.back().plan.captured_at;
    constexpr Duration kRound = std::chrono::minutes(2);  // both sensors are asked within it
    for (const auto& [id, stay] : stays_of(timeline)) {
      const simulator::ObjectState& object = timeline.object(id);
      if (object.kind == "person") {
        ++passers_;
      } else if (stay.from > first + kRound) {
        add(object, ChangeKind::added, stay.from);
      } else if (stay.until < last - kRound) {
        add(object, ChangeKind::removed, stay.until);
      }
    }
    std::ranges::stable_sort(expected_, {}, [](const Expected& e) { return e.planted.at; });
  }

  /// Counts an alert for what it is about. False when nothing planted explains it.
  bool explain(ChangeKind kind, const Eigen::AlignedBox3d& box_m, Time at) {
    const auto fits = [&](const Expected& e) {
      constexpr double kMargin_m = 0.3;
      const Eigen::AlignedBox3d wide_m(e.box_m.min().array() - kMargin_m, e.box_m.max().array() + kMargin_m);
      return e.planted.kind == kind && e.planted.at <= at && wide_m.contains(box_m.center());
    };
    const auto found = std::ranges::find_if(expected_, fits);
    if (found == expected_.end()) return false;
    ++found->planted.alerts;
    return true;
  }

  std::size_t passers() const { return passers_; }
  std::vector<Planted> planted() const {
    std::vector<Planted> all;
    for (const Expected& e : expected_) all.push_back(e.planted);
    return all;
  }

 private:
  void add(const simulator::ObjectState& object, ChangeKind kind, Time at) {
    expected_.push_back({{object.name, kind, at}, object.box});
  }

  std::vector<Expected> expected_;
  std::size_t passers_ = 0;
};

void watch(WatchedSite& site, const Timeline& timeline, const std::function<void(std::size_t)>& progress) {
  tbb::task_arena arena(2);
  for (std::size_t i = 0; i < timeline.moments.size(); ++i) {
    simulator::SimulatedScan scan = arena.execute([&] { return take_scan(timeline, timeline.moments[i]); });
    site.set_now(scan.captured_at + std::chrono::seconds(1));
    site.put({.sensor = scan.sensor,
              .points = std::move(scan.points),
              .world_from_sensor = scan.reported_world_from_sensor,
              .captured_at = scan.captured_at});
    progress(i + 1);
  }
}

}  // namespace

std::size_t NightsResult::told(std::size_t times) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(planted, [&](const Planted& thing) { return thing.alerts == times; }));
}

NightsResult watch_nights(const NightsOptions& options, const std::function<void(std::size_t)>& progress) {
  const Timeline timeline = nights_timeline(options);
  WatchedSite site({.profile = Profile::outdoor,
                    .parameters = default_parameters(Profile::outdoor, Grouping::consensus),
                    .sensors_are_fixed = true});
  watch(site, timeline, progress);

  Truth truth(timeline);
  NightsResult result{.scans = timeline.moments.size(), .passers = truth.passers()};
  std::map<std::int64_t, Track> tracks;
  for (const TrackRecord& record : site.tracks()) tracks.emplace(record.track.id.value, record.track);
  for (const AlertRecord& alert : site.alerts()) {
    const Track* track = alert.track ? &tracks.at(alert.track->value) : nullptr;
    if (track && truth.explain(track->kind, track->anchor_m, alert.opened_at)) continue;
    result.false_alerts.push_back({alert.opened_at, alert.title, track ? track->anchor_m : Eigen::AlignedBox3d()});
  }
  result.planted = truth.planted();
  return result;
}

}  // namespace raywatch::evaluation
