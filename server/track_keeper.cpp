#include "server/track_keeper.hpp"

#include <algorithm>
#include <cstdio>
#include <ranges>
#include <string>

#include "storage/events.hpp"
#include "storage/local_time.hpp"
#include "storage/zones.hpp"

namespace raywatch {
namespace {

using Places = std::vector<std::size_t>;

std::string size_text(const OrientedBox& box) {
  char text[80];
  std::snprintf(text, sizeof text, "%.2f x %.2f x %.2f m", box.size_m.x(), box.size_m.y(), box.size_m.z());
  return text;
}

std::string what_happened(const Track& track) {
  return std::string("Something of ") + size_text(track.latest.box) + " was " + std::string(to_string(track.kind));
}

std::string alert_title(const Snapshot& snapshot, const Track& track, const RuleRecord& rule) {
  std::string title = what_happened(track);
  if (rule.rule.zone) title += " in zone " + find_zone(snapshot, *rule.rule.zone).value().name;
  return title + ".";
}

std::string opening_note(const Track& track, const Rule& rule) {
  char text[160];
  const std::chrono::duration<double> age = between(track.first_seen_at, track.last_seen_at);
  std::snprintf(text, sizeof text, "Seen in %u of the last %u scans that could see the place, over %.0f s.",
                seen_of_last(track, rule.persistence.of), std::min(rule.persistence.of, track.remembered), age.count());
  return text;
}

}  // namespace

void TrackKeeper::run() {
  std::vector<TrackRecord> followed = followed_tracks(transaction_, turn_.site);
  std::vector<Track> tracks;
  for (const TrackRecord& record : followed) tracks.push_back(record.track);
  const std::vector<std::optional<std::size_t>> track_of = associate(tracks, watched_.changes);
  std::vector<Places> changes_of(tracks.size());
  Places fresh;
  for (std::size_t c = 0; c < track_of.size(); ++c) {
    if (track_of[c]) {
      changes_of[*track_of[c]].push_back(c);
    } else if (watched_.changes[c].kind != ChangeKind::discrepancy) {
      fresh.push_back(c);
    }
  }
  for (std::size_t t = 0; t < followed.size(); ++t) follow(std::move(followed[t]), changes_of[t]);
  for (const Places& group : group_fragments(watched_.changes, fresh)) begin(group);
  assign_other_comparisons();
  judge_told();
}

void TrackKeeper::follow(TrackRecord record, const Places& changes) {
  Track& track = record.track;
  const bool was_open = track.state == TrackState::open;
  Sight sight = Sight::seen;
  if (!changes.empty()) {
    const std::size_t main =
        *std::ranges::max_element(changes, {}, [&](std::size_t c) { return watched_.changes[c].points; });
    see(track, watched_.changes[main], glance_.samples[main], turn_.captured_at);
    record.latest_change = watched_.ids[main];
    assign(changes, track.id);
  } else {
    const auto asked = glance_.sights.find(track.id);
    sight = asked == glance_.sights.end() ? Sight::unseen : asked->second;
    if (sight == Sight::seen) see_still(track, turn_.captured_at);
    if (sight == Sight::absent) miss(track, turn_.captured_at);
  }
  note_sight(transaction_, track.id, turn_, sight);
  if (sight == Sight::unseen) return;
  if (sight == Sight::seen) {
    record.last_scan = turn_.scan;
    record.ended_scan.reset();
  } else if (was_open) {
    record.ended_scan = turn_.scan;
  }
  update_track(transaction_, record);
  if (was_open && sight == Sight::absent) add_event("track.ended", track, what_happened(track) + " and is so no more.");
  if (!was_open && sight == Sight::seen) add_event("track.reopened", track, what_happened(track) + " again.");
  told_.push_back({std::move(record), sight});
}

void TrackKeeper::begin(const Places& changes) {
  const std::size_t main = changes.front();
  TrackRecord record{.track = begin_track(watched_.changes[main], glance_.samples[main], turn_.captured_at),
                     .site = turn_.site,
                     .first_scan = turn_.scan,
                     .last_scan = turn_.scan,
                     .ended_scan = {},
                     .latest_change = watched_.ids[main]};
  record.track.id = insert_track(transaction_, record);
  note_sight(transaction_, record.track.id, turn_, Sight::seen);
  assign(changes, record.track.id);
  add_event("track.started", record.track, what_happened(record.track) + ".");
  link_to_other_place(record);
  told_.push_back({std::move(record), Sight::seen});
}

/// What is missing here and what is found there may be one object that was moved.
void TrackKeeper::link_to_other_place(const TrackRecord& record) {
  const Track& track = record.track;
  const std::vector<TrackRecord> recent =
      tracks_begun(transaction_, turn_.site, shifted(turn_.captured_at, -options_.moved_within), turn_.captured_at);
  const TrackRecord* best = nullptr;
  for (const TrackRecord& other : recent) {
    if (other.track.kind == track.kind || other.track.state != TrackState::open || other.moved_from || other.moved_to ||
        !are_alike(other.track.latest.box, track.latest.box)) {
      continue;
    }
    if (best == nullptr || size_difference_m(other.track.latest.box, track.latest.box) <
                               size_difference_m(best->track.latest.box, track.latest.box)) {
      best = &other;
    }
  }
  if (best == nullptr) return;
  const bool found_here = track.kind == ChangeKind::added;
  link_moved(transaction_, found_here ? best->track.id : track.id, found_here ? track.id : best->track.id);
}

void TrackKeeper::assign(const Places& changes, TrackId track) {
  for (const std::size_t c : changes) set_track(transaction_, watched_.ids[c], track);
}

/// The same scan, compared with something else, shows the same things.
void TrackKeeper::assign_other_comparisons() {
  for (const ComparisonRecord& comparison : comparisons_of(transaction_, turn_.scan)) {
    if (comparison.watching || comparison.changes == 0) continue;
    const Page<ChangeRecord> others =
        list_changes(transaction_, {.comparison = comparison.id}, {.limit = 1000, .cursor = {}});
    for (const ChangeRecord& other : others.items) {
      const auto same = std::ranges::find_if(told_, [&](const Told& told) {
        return told.sight == Sight::seen && told.record.track.kind == other.change.kind &&
               told.record.track.latest.bounds_m.intersects(other.change.bounds_m);
      });
      if (same != told_.end()) set_track(transaction_, other.id, same->record.track.id);
    }
  }
}

void TrackKeeper::judge_told() {
  const Rulebook book = rulebook_of(transaction_, turn_.site, turn_.captured_at);
  std::vector<TrackSight> sights;
  std::vector<StandingAlert> alerts;
  for (const Told& told : told_) {
    sights.push_back({told.record.track, told.sight});
    for (const AlertRecord& alert : alerts_of(transaction_, told.record.track.id)) alerts.push_back(standing(alert));
  }
  const JudgedScan scan{.at = turn_.captured_at,
                        .local = local_moment(turn_.captured_at, watched_.site.time_zone),
                        .sensor = turn_.sensor};
  for (const AlertStep& step : judge(scan, sights, book, alerts)) apply(step);
}

void TrackKeeper::apply(const AlertStep& step) {
  using enum AlertStep::Kind;
  const auto told = std::ranges::find_if(told_, [&](const Told& t) { return t.record.track.id == step.track; });
  const Track& track = told->record.track;
  if (step.kind == open) return open_alert_about(track, step);
  AlertChange change{.by = std::string(kProgram), .at = options_.now, .scan = turn_.scan};
  if (step.kind == resolve) {
    change.action = "resolved";
    change.note = track.kind == ChangeKind::added ? "It is gone." : "It is back.";
    change.state = AlertState::resolved;
    change.resolved_as_gone = true;
  } else {
    change.action = step.kind == reopen ? "reopened" : "raised";
    change.note = step.kind == reopen ? "It is so again." : "The rule is more severe now.";
    if (step.kind == reopen) change.state = AlertState::open;
    change.severity = step.severity;
  }
  change_alert(transaction_, step.alert.value(), change);
}

void TrackKeeper::open_alert_about(const Track& track, const AlertStep& step) {
  const RuleRecord rule = find_rule(transaction_, step.rule).value();
  open_alert(transaction_,
             {.site = turn_.site,
              .title = alert_title(transaction_, track, rule),
              .severity = step.severity,
              .track = track.id,
              .rule = rule.rule.id,
              .zone = rule.rule.zone,
              .sensor = turn_.sensor,
              .scan = turn_.scan,
              .rule_name = rule.name,
              .rule_then = rule.rule,
              .auto_resolve = rule.rule.auto_resolve,
              .opened_at = options_.now},
             opening_note(track, rule.rule));
}

void TrackKeeper::add_event(const std::string& type, const Track& track, const std::string& text) {
  insert_event(transaction_, {.at = options_.now,
                              .type = type,
                              .site = turn_.site,
                              .scan = turn_.scan,
                              .comparison = watched_.comparison,
                              .track = track.id,
                              .sensor = turn_.sensor,
                              .text = text});
}

}  // namespace raywatch
