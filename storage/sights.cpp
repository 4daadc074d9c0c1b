#include <algorithm>

#include "core/names.hpp"
#include "storage/columns.hpp"
#include "storage/snapshot.hpp"
#include "storage/tracks.hpp"

namespace raywatch {
namespace {

constexpr Names<WatchRole, 5> kRoles{{{WatchRole::tracked, "tracked"},
                                      {WatchRole::learning, "learning"},
                                      {WatchRole::late, "late"},
                                      {WatchRole::suspect, "suspect"},
                                      {WatchRole::misplaced, "misplaced"}}};

Sight take_sight(Statement& row) {
  return enum_from_text(row.take<std::string>(), {Sight::seen, Sight::absent, Sight::unseen});
}

}  // namespace

std::string_view to_string(WatchRole role) { return name_of(kRoles, role); }

std::int64_t insert_watched_scan(Transaction& transaction, const WatchedScan& scan) {
  Database& database = database_of(transaction);
  database.run("INSERT INTO watched_scans (scan, site, sensor, vantage, captured_at, role) VALUES (?, ?, ?, ?, ?, ?)",
               scan.scan, scan.site, scan.sensor, scan.vantage, scan.captured_at, to_string(scan.role));
  return database.last_id();
}

std::optional<WatchedScan> find_watched_scan(const Snapshot& snapshot, ScanId scan) {
  Statement row(database_of(snapshot),
                "SELECT turn, scan, site, sensor, vantage, captured_at, role FROM watched_scans INDEXED BY "
                "watched_scans_by_scan WHERE scan = ?");
  if (!row.bind(scan).next()) return std::nullopt;
  WatchedScan found;
  found.turn = row.take<std::int64_t>();
  found.scan = row.take<ScanId>();
  found.site = row.take<SiteId>();
  found.sensor = row.take<SensorId>();
  found.vantage = row.take<VantageId>();
  found.captured_at = row.take<Time>();
  found.role = value_of(kRoles, row.take<std::string>(), "role");
  return found;
}

std::optional<Time> tracked_until(const Snapshot& snapshot, SiteId site) {
  return database_of(snapshot).find<Time>(
      "SELECT captured_at FROM watched_scans INDEXED BY watched_scans_by_site WHERE site = ? AND role = 'tracked' "
      "ORDER BY captured_at DESC LIMIT 1",
      site);
}

std::optional<Time> tracked_until(const Snapshot& snapshot, SensorId sensor) {
  return database_of(snapshot).find<Time>(
      "SELECT captured_at FROM watched_scans INDEXED BY watched_scans_by_sensor WHERE sensor = ? AND role = 'tracked' "
      "ORDER BY captured_at DESC LIMIT 1",
      sensor);
}

void note_sight(Transaction& transaction, TrackId track, const WatchedScan& scan, Sight sight) {
  Database& database = database_of(transaction);
  std::optional<std::int64_t> run;
  {
    Statement last(database,
                   "SELECT first_turn, sight FROM sight_runs WHERE track = ? AND vantage = ? "
                   "ORDER BY first_turn DESC LIMIT 1");
    if (last.bind(track, scan.vantage).next()) {
      run = last.take<std::int64_t>();
      if (take_sight(last) != sight) run.reset();
    }
  }
  if (run) {
    database.run(
        "UPDATE sight_runs SET last_turn = ?, scans = scans + 1 WHERE track = ? AND vantage = ? AND first_turn = ?",
        scan.turn, track, scan.vantage, *run);
  } else {
    database.run("INSERT INTO sight_runs VALUES (?, ?, ?, ?, ?, 1)", track, scan.vantage, scan.turn, scan.turn,
                 to_string(sight));
  }
}

std::vector<SightRun> sight_runs(const Snapshot& snapshot, TrackId track) {
  Statement rows(database_of(snapshot),
                 "SELECT r.vantage, r.first_turn, r.last_turn, r.sight, r.scans, a.scan, a.captured_at, z.scan, "
                 "z.captured_at FROM sight_runs AS r CROSS JOIN watched_scans AS a ON a.turn = r.first_turn "
                 "CROSS JOIN watched_scans AS z ON z.turn = r.last_turn WHERE r.track = ?");
  rows.bind(track);
  std::vector<SightRun> runs;
  while (rows.next()) {
    SightRun& run = runs.emplace_back();
    run.vantage = rows.take<VantageId>();
    run.first_turn = rows.take<std::int64_t>();
    run.last_turn = rows.take<std::int64_t>();
    run.sight = take_sight(rows);
    run.scans = rows.take<std::uint64_t>();
    run.first_scan = rows.take<ScanId>();
    run.first_at = rows.take<Time>();
    run.last_scan = rows.take<ScanId>();
    run.last_at = rows.take<Time>();
  }
  std::ranges::sort(runs, {}, &SightRun::first_turn);
  return runs;
}

std::vector<SightOfScan> telling_sights(const Snapshot& snapshot, TrackId track) {
  std::vector<SightOfScan> sights;
  for (const SightRun& run : sight_runs(snapshot, track)) {
    if (run.sight == Sight::unseen) continue;
    Statement rows(database_of(snapshot),
                   "SELECT turn, scan, sensor, captured_at FROM watched_scans INDEXED BY watched_scans_by_vantage "
                   "WHERE vantage = ? AND role = 'tracked' AND turn BETWEEN ? AND ? ORDER BY turn");
    rows.bind(run.vantage, run.first_turn, run.last_turn);
    while (rows.next()) {
      SightOfScan& sight = sights.emplace_back();
      sight.turn = rows.take<std::int64_t>();
      sight.scan = rows.take<ScanId>();
      sight.sensor = rows.take<SensorId>();
      sight.captured_at = rows.take<Time>();
      sight.sight = run.sight;
    }
  }
  std::ranges::sort(sights, {}, &SightOfScan::turn);
  return sights;
}

}  // namespace raywatch
