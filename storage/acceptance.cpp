#include "storage/acceptance.hpp"

#include <map>

#include "core/error.hpp"

#include "storage/alerts.hpp"
#include "storage/events.hpp"
#include "storage/scans.hpp"

namespace raywatch {
namespace {

/// How far beyond what was seen of a thing it is asked about: its edges are noisy, and its far side was not seen.
constexpr double kMargin_m = 0.15;

void end_as_accepted(Transaction& transaction, TrackRecord record, const AcceptedBy& who) {
  record.track.state = TrackState::accepted;
  record.track.ended_at = record.track.last_told_at;
  update_track(transaction, record);
  insert_event(transaction, {.at = who.at,
                             .type = "track.accepted",
                             .site = record.site,
                             .track = record.track.id,
                             .text = "It was accepted as normal by " + who.by + "."});
  for (const AlertRecord& alert : alerts_of(transaction, record.track.id)) {
    if (alert.state == AlertState::resolved) continue;
    change_alert(transaction, alert.id,
                 {.action = "accepted", .by = who.by, .note = who.note, .at = who.at, .state = AlertState::resolved});
  }
}

/// The last scan of each vantage that saw a track.
std::vector<BaselineEntry> scans_that_show(const Snapshot& snapshot, TrackId track,
                                           const Eigen::AlignedBox3d& region_m) {
  std::map<VantageId, ScanId> last;
  for (const SightRun& run : sight_runs(snapshot, track)) {
    if (run.sight == Sight::seen) last[run.vantage] = run.last_scan;
  }
  std::vector<BaselineEntry> entries;
  for (const auto& [vantage, scan] : last) {
    if (!find_scan(snapshot, scan)) continue;
    entries.push_back({.scan = scan, .vantage = vantage, .origin = BaselineOrigin::accepted, .region_m = region_m});
  }
  return entries;
}

BaselineEntry entry_of(const Snapshot& snapshot, SiteId site, ScanId id,
                       const std::optional<Eigen::AlignedBox3d>& region_m) {
  const std::string name = "scan " + std::to_string(id.value);
  const std::optional<ScanRecord> scan = find_scan(snapshot, id);
  if (!scan) throw NotFound(name + " does not exist");
  if (scan->site != site) throw InvalidInput(name + " is of another site", {{"scans", name + " is of another site"}});
  if (scan->registration.state == RegistrationState::bad) {
    throw InvalidInput(name + " does not fit onto the others", {{"scans", name + ": its registration is bad"}});
  }
  return {.scan = id, .vantage = scan->vantage, .origin = BaselineOrigin::accepted, .region_m = region_m};
}

void end_tracks_within(Transaction& transaction, SiteId site, const std::optional<Eigen::AlignedBox3d>& region_m,
                       const AcceptedBy& who) {
  for (TrackRecord& record : followed_tracks(transaction, site)) {
    if (record.track.state != TrackState::open) continue;
    if (region_m && !region_m->contains(record.track.latest.centroid_m)) continue;
    end_as_accepted(transaction, std::move(record), who);
  }
}

}  // namespace

BaselineVersion accept_track(Transaction& transaction, TrackId track, const AcceptedBy& who) {
  std::optional<TrackRecord> record = find_track(transaction, track);
  if (!record) throw NotFound("there is no track " + std::to_string(track.value));
  if (record->track.state != TrackState::open) {
    throw Conflict("track " + std::to_string(track.value) + " is " + std::string(to_string(record->track.state)) +
                   ": there is nothing to accept any more");
  }
  Eigen::AlignedBox3d region_m = record->track.anchor_m.merged(record->track.latest.bounds_m);
  region_m.min().array() -= kMargin_m;
  region_m.max().array() += kMargin_m;
  BaselineEdit edit{.kind = "accepted", .by = who.by, .note = who.note};
  edit.add = scans_that_show(transaction, track, region_m);
  if (edit.add.empty())
    throw Conflict("no scan that shows track " + std::to_string(track.value) + " is stored any more");
  const SiteId site = record->site;
  end_as_accepted(transaction, std::move(*record), who);
  return edit_baseline(transaction, site, edit, who.at);
}

BaselineVersion accept_scans(Transaction& transaction, SiteId site, const AcceptedScans& accepted,
                             const AcceptedBy& who) {
  BaselineEdit edit{
      .kind = accepted.replace ? "replaced" : "accepted", .by = who.by, .note = who.note, .clear = accepted.replace};
  for (const ScanId scan : accepted.scans) {
    edit.add.push_back(entry_of(transaction, site, scan, accepted.region_m));
  }
  end_tracks_within(transaction, site, accepted.region_m, who);
  return edit_baseline(transaction, site, edit, who.at);
}

BaselineVersion learn_anew(Transaction& transaction, SiteId site, const AcceptedBy& who) {
  end_tracks_within(transaction, site, std::nullopt, who);
  return edit_baseline(transaction, site, {.kind = "emptied", .by = who.by, .note = who.note, .clear = true}, who.at);
}

}  // namespace raywatch
