#include "storage/rehearsal.hpp"

#include <algorithm>
#include <tuple>

#include "storage/comparisons.hpp"
#include "storage/local_time.hpp"
#include "storage/rules.hpp"
#include "storage/tracks.hpp"

namespace raywatch {
namespace {

/// One track, judged again from its beginning.
class Replay {
 public:
  Replay(const Snapshot& snapshot, const Site& site, const Rulebook& book, const TrackRecord& record)
      : snapshot_(snapshot), site_(site), book_(book), record_(record) {}

  std::vector<RehearsedAlert> run(Time from, Time to) {
    for (const SightOfScan& sight : telling_sights(snapshot_, record_.track.id)) {
      if (sight.captured_at >= to) break;
      take(sight);
      judge_at(sight, sight.captured_at >= from);
    }
    return std::move(alerts_);
  }

 private:
  void take(const SightOfScan& sight) {
    if (sight.sight == Sight::absent) return miss(track_, sight.captured_at);
    const std::vector<ChangeRecord> changes = changes_of_track(snapshot_, record_.track.id, sight.scan);
    if (changes.empty() && track_.seen > 0) return see_still(track_, sight.captured_at);
    // Of a scan that was deleted the changes are gone as well; the latest stands for them.
    const Change& change =
        changes.empty()
            ? record_.track.latest
            : std::ranges::max_element(changes, {}, [](const ChangeRecord& c) { return c.change.points; })->change;
    if (track_.seen == 0) {
      track_ = begin_track(change, {}, sight.captured_at);
      track_.id = record_.track.id;
    } else {
      see(track_, change, {}, sight.captured_at);
    }
  }

  void judge_at(const SightOfScan& sight, bool counts) {
    const JudgedScan scan{
        .at = sight.captured_at, .local = local_moment(sight.captured_at, site_.time_zone), .sensor = sight.sensor};
    const std::vector<TrackSight> sights{{track_, sight.sight}};
    for (const AlertStep& step : judge(scan, sights, book_, standing_)) {
      if (step.kind == AlertStep::Kind::resolve) {
        standing_.front().state = AlertState::resolved;
        standing_.front().resolved_as_gone = true;
        if (!alerts_.empty()) alerts_.back().resolved_at = sight.captured_at;
      } else if (step.kind == AlertStep::Kind::reopen) {
        standing_.front().state = AlertState::open;
        standing_.front().resolved_as_gone = false;
        if (!alerts_.empty()) alerts_.back().resolved_at.reset();
      } else if (step.kind == AlertStep::Kind::open) {
        standing_.push_back({.id = AlertId{1},
                             .track = track_.id,
                             .rule = step.rule,
                             .severity = step.severity,
                             .auto_resolve = book_.rules.front().auto_resolve});
        if (counts) alerts_.push_back({track_.id, sight.scan, sight.captured_at, step.severity, {}});
      }
    }
  }

  const Snapshot& snapshot_;
  const Site& site_;
  const Rulebook& book_;
  const TrackRecord& record_;
  Track track_;
  std::vector<StandingAlert> standing_;
  std::vector<RehearsedAlert> alerts_;
};

}  // namespace

std::vector<RehearsedAlert> rehearse(const Snapshot& snapshot, const Rule& rule, const Site& site, Time from, Time to) {
  Rulebook book = rulebook_of(snapshot, site.id, Time::min());
  book.rules = {rule};
  book.rules.front().enabled = true;
  std::vector<RehearsedAlert> alerts;
  for (const TrackRecord& record : tracks_begun(snapshot, site.id, Time::min(), to)) {
    if (record.track.last_told_at < from) continue;
    const std::vector<RehearsedAlert> raised = Replay(snapshot, site, book, record).run(from, to);
    alerts.insert(alerts.end(), raised.begin(), raised.end());
  }
  std::ranges::sort(alerts, {}, [](const RehearsedAlert& alert) { return std::tuple(alert.at, alert.track); });
  return alerts;
}

}  // namespace raywatch
