#include "storage/zones.hpp"

#include <array>
#include <limits>

#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/sites.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kZoneList = "zones", kCoverageList = "coverage";
const std::string kSelectZones =
    "SELECT id, site, name, kind, polygon, z_min_m, z_max_m, created_at, edited_at FROM zones ";

ZoneRecord read_zone(Statement& row) {
  ZoneRecord record;
  record.zone.id = row.take<ZoneId>();
  record.site = row.take<SiteId>();
  record.name = row.take<std::string>();
  record.zone.kind = parse_zone_kind(row.take<std::string>());
  record.zone.prism.polygon_m = polygon_from_json(row.take<std::string>());
  record.zone.prism.z_min_m = row.take<double>();
  record.zone.prism.z_max_m = row.take<double>();
  record.created_at = row.take<Time>();
  record.edited_at = row.take<Time>();
  return record;
}

void require_free_name(const Snapshot& snapshot, const ZoneRecord& zone) {
  const std::optional<ZoneRecord> other = find_zone(snapshot, zone.site, zone.name);
  if (other && other->zone.id != zone.zone.id) {
    throw Conflict("the site has a zone named \"" + zone.name + "\" already");
  }
}

}  // namespace

ZoneRecord insert_zone(Transaction& transaction, const ZoneRecord& zone, Time now) {
  transaction.impl().require_room_for_records();
  if (!find_site(transaction, zone.site)) throw NotFound("there is no site " + std::to_string(zone.site.value));
  require_free_name(transaction, zone);
  const Prism& prism = zone.zone.prism;
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO zones (site, name, kind, polygon, z_min_m, z_max_m, created_at, edited_at) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
      zone.site, zone.name, to_string(zone.zone.kind), polygon_json(prism.polygon_m), prism.z_min_m, prism.z_max_m, now,
      now);
  return find_zone(transaction, ZoneId{database.last_id()}).value();
}

std::optional<ZoneRecord> find_zone(const Snapshot& snapshot, ZoneId id) {
  Statement row(database_of(snapshot), kSelectZones + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_zone(row);
}

std::optional<ZoneRecord> find_zone(const Snapshot& snapshot, SiteId site, std::string_view name) {
  Statement row(database_of(snapshot), kSelectZones + "INDEXED BY zones_by_name WHERE site = ? AND name = ?");
  if (!row.bind(site, name).next()) return std::nullopt;
  return read_zone(row);
}

Page<ZoneRecord> list_zones(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  const auto [after] = key_before<1>(page, kZoneList, {0});
  Statement rows(
      database_of(snapshot),
      kSelectZones + (site ? "INDEXED BY zones_by_site WHERE site = ? AND " : "WHERE ") + "id > ? ORDER BY id LIMIT ?");
  if (site) rows.bind(*site);
  rows.bind(after, rows_to_read(page));
  std::vector<ZoneRecord> zones;
  while (rows.next()) zones.push_back(read_zone(rows));
  return make_page(std::move(zones), page, kZoneList, [](const ZoneRecord& z) { return std::array{z.zone.id.value}; });
}

std::vector<Zone> zones_of(const Snapshot& snapshot, SiteId site) {
  Statement rows(database_of(snapshot), kSelectZones + "INDEXED BY zones_by_site WHERE site = ? ORDER BY id");
  rows.bind(site);
  std::vector<Zone> zones;
  while (rows.next()) zones.push_back(read_zone(rows).zone);
  return zones;
}

ZoneRecord replace_zone(Transaction& transaction, const ZoneRecord& zone, Time now) {
  require_free_name(transaction, zone);
  const Prism& prism = zone.zone.prism;
  const ZoneRecord before = find_zone(transaction, zone.zone.id).value();
  const bool same = prism.polygon_m == before.zone.prism.polygon_m && prism.z_min_m == before.zone.prism.z_min_m &&
                    prism.z_max_m == before.zone.prism.z_max_m;
  if (!same) database_of(transaction).run("DELETE FROM zone_coverage WHERE zone = ?", zone.zone.id);
  database_of(transaction)
      .run("UPDATE zones SET name = ?, kind = ?, polygon = ?, z_min_m = ?, z_max_m = ?, edited_at = ? WHERE id = ?",
           zone.name, to_string(zone.zone.kind), polygon_json(prism.polygon_m), prism.z_min_m, prism.z_max_m, now,
           zone.zone.id);
  return find_zone(transaction, zone.zone.id).value();
}

void delete_zone(Transaction& transaction, ZoneId id) {
  Database& database = database_of(transaction);
  if (const auto rule =
          database.find<std::string>("SELECT name FROM rules INDEXED BY rules_by_zone WHERE zone = ?", id)) {
    throw Conflict("the rule \"" + *rule + "\" looks into this zone; delete or change the rule first");
  }
  database.run("DELETE FROM zone_coverage WHERE zone = ?", id);
  database.run("DELETE FROM silences WHERE zone = ?", id);
  database.run("DELETE FROM zones WHERE id = ?", id);
}

void insert_coverage(Transaction& transaction, ZoneId zone, std::int64_t turn, double share) {
  database_of(transaction).run("INSERT INTO zone_coverage VALUES (?, ?, ?)", zone, turn, share);
}

namespace {

std::vector<double> coverage_from(const Snapshot& snapshot, std::string_view order, ZoneId zone, VantageId vantage,
                                  std::size_t count) {
  // Before the first coverage of the zone there are none to be found.
  Statement rows(database_of(snapshot),
                 "SELECT c.share FROM watched_scans AS w INDEXED BY watched_scans_by_vantage CROSS JOIN zone_coverage "
                 "AS c ON c.zone = ?1 AND c.turn = w.turn WHERE w.vantage = ?2 AND w.role = 'tracked' AND "
                 "w.turn >= (SELECT min(turn) FROM zone_coverage WHERE zone = ?1) ORDER BY w.turn " +
                     std::string(order) + " LIMIT ?3");
  rows.bind(zone, vantage, count);
  std::vector<double> shares;
  while (rows.next()) shares.push_back(rows.take<double>());
  return shares;
}

}  // namespace

std::vector<double> first_coverage(const Snapshot& snapshot, ZoneId zone, VantageId vantage, std::size_t count) {
  return coverage_from(snapshot, "ASC", zone, vantage, count);
}

std::vector<double> last_coverage(const Snapshot& snapshot, ZoneId zone, VantageId vantage, std::size_t count) {
  return coverage_from(snapshot, "DESC", zone, vantage, count);
}

Page<ZoneCoverage> list_coverage(const Snapshot& snapshot, ZoneId zone, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kCoverageList, {std::numeric_limits<std::int64_t>::max()});
  Statement rows(database_of(snapshot),
                 "SELECT c.turn, w.scan, w.sensor, w.vantage, w.captured_at, c.share FROM zone_coverage AS c "
                 "CROSS JOIN watched_scans AS w ON w.turn = c.turn WHERE c.zone = ? AND c.turn < ? "
                 "ORDER BY c.turn DESC LIMIT ?");
  rows.bind(zone, before, rows_to_read(page));
  std::vector<ZoneCoverage> list;
  while (rows.next()) {
    ZoneCoverage& coverage = list.emplace_back();
    coverage.turn = rows.take<std::int64_t>();
    coverage.scan = rows.take<ScanId>();
    coverage.sensor = rows.take<SensorId>();
    coverage.vantage = rows.take<VantageId>();
    coverage.captured_at = rows.take<Time>();
    coverage.share = rows.take<double>();
  }
  return make_page(std::move(list), page, kCoverageList, [](const ZoneCoverage& c) { return std::array{c.turn}; });
}

}  // namespace raywatch
