#include "storage/baselines.hpp"

#include <array>
#include <limits>

#include "core/names.hpp"
#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/events.hpp"
#include "storage/sites.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kBaselineList = "baselines", kLatestList = "latest-baselines";
constexpr Names<BaselineOrigin, 3> kOrigins{
    {{BaselineOrigin::learned, "learned"}, {BaselineOrigin::joined, "joined"}, {BaselineOrigin::accepted, "accepted"}}};
const std::string kSelectVersions = "SELECT site, version, kind, made_at, actor, note FROM baselines ";
const std::string kSelectEntries =
    "SELECT scan, vantage, origin, min_x_m, min_y_m, min_z_m, max_x_m, max_y_m, max_z_m, from_version "
    "FROM baseline_entries ";

BaselineVersion read_version(Statement& row) {
  BaselineVersion version;
  version.site = row.take<SiteId>();
  version.version = row.take<std::int64_t>();
  version.kind = row.take<std::string>();
  version.made_at = row.take<Time>();
  version.by = row.take<std::string>();
  version.note = row.take<std::string>();
  return version;
}

std::vector<BaselineEntry> all_entries(Statement& rows) {
  std::vector<BaselineEntry> entries;
  while (rows.next()) {
    BaselineEntry& entry = entries.emplace_back();
    entry.scan = rows.take<ScanId>();
    entry.vantage = rows.take<VantageId>();
    entry.origin = value_of(kOrigins, rows.take<std::string>(), "origin");
    entry.region_m = take_optional_box(rows);
    entry.from_version = rows.take<std::int64_t>();
  }
  return entries;
}

void insert_entry(Database& database, SiteId site, std::int64_t version, const BaselineEntry& entry) {
  Statement row(database,
                "INSERT INTO baseline_entries (site, scan, vantage, origin, min_x_m, min_y_m, min_z_m, max_x_m, "
                "max_y_m, max_z_m, from_version) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  row.bind(site, entry.scan, entry.vantage, to_string(entry.origin));
  for (const std::optional<double>& column : box_columns(entry.region_m)) row.bind(column);
  row.bind(version);
  row.next();
}

std::vector<BaselineVersion> all_versions(Statement& rows) {
  std::vector<BaselineVersion> versions;
  while (rows.next()) versions.push_back(read_version(rows));
  return versions;
}

}  // namespace

std::string_view to_string(BaselineOrigin origin) { return name_of(kOrigins, origin); }

BaselineVersion edit_baseline(Transaction& transaction, SiteId site, const BaselineEdit& edit, Time now) {
  transaction.impl().require_room_for_records();
  if (!find_site(transaction, site)) throw NotFound("there is no site " + std::to_string(site.value));
  Database& database = database_of(transaction);
  const std::optional<BaselineVersion> before = latest_baseline(transaction, site);
  const std::int64_t version = before ? before->version + 1 : 1;
  database.run("INSERT INTO baselines VALUES (?, ?, ?, ?, ?, ?)", site, version, edit.kind, now, edit.by, edit.note);
  if (edit.clear) {
    database.run(
        "UPDATE baseline_entries INDEXED BY baseline_entries_now SET until_version = ? WHERE site = ? AND "
        "until_version IS NULL",
        version, site);
  }
  for (const BaselineEntry& entry : edit.add) insert_entry(database, site, version, entry);
  insert_event(transaction, {.at = now,
                             .type = "baseline." + edit.kind,
                             .site = site,
                             .scan = edit.add.size() == 1 ? std::optional(edit.add.front().scan) : std::nullopt,
                             .text = "The baseline has version " + std::to_string(version) + " (" + edit.kind + ")."});
  return find_baseline(transaction, site, version).value();
}

void withdraw_from_baseline(Transaction& transaction, ScanId scan, Time now) {
  Database& database = database_of(transaction);
  const auto site = database.find<SiteId>(
      "SELECT site FROM baseline_entries INDEXED BY baseline_entries_by_scan WHERE scan = ? AND until_version IS NULL",
      scan);
  if (!site) return;
  const BaselineVersion version = edit_baseline(
      transaction, *site,
      {.kind = "withdrawn", .by = "raywatch", .note = "scan " + std::to_string(scan.value) + " was deleted"}, now);
  database.run(
      "UPDATE baseline_entries INDEXED BY baseline_entries_by_scan SET until_version = ? WHERE scan = ? AND "
      "until_version IS NULL",
      version.version, scan);
}

std::optional<BaselineVersion> latest_baseline(const Snapshot& snapshot, SiteId site) {
  Statement row(database_of(snapshot), kSelectVersions + "WHERE site = ? ORDER BY version DESC LIMIT 1");
  if (!row.bind(site).next()) return std::nullopt;
  return read_version(row);
}

std::optional<BaselineVersion> find_baseline(const Snapshot& snapshot, SiteId site, std::int64_t version) {
  Statement row(database_of(snapshot), kSelectVersions + "WHERE site = ? AND version = ?");
  if (!row.bind(site, version).next()) return std::nullopt;
  return read_version(row);
}

std::vector<BaselineEntry> baseline_entries(const Snapshot& snapshot, SiteId site, std::int64_t version) {
  Statement rows(database_of(snapshot),
                 kSelectEntries +
                     "INDEXED BY baseline_entries_by_site WHERE site = ?1 AND from_version <= ?2 AND "
                     "(until_version IS NULL OR until_version > ?2) ORDER BY id");
  rows.bind(site, version);
  return all_entries(rows);
}

Page<BaselineVersion> list_baselines(const Snapshot& snapshot, SiteId site, const PageRequest& page) {
  const auto [before] = key_before<1>(page, kBaselineList, {std::numeric_limits<std::int64_t>::max()});
  Statement rows(database_of(snapshot),
                 kSelectVersions + "WHERE site = ? AND version < ? ORDER BY version DESC LIMIT ?");
  rows.bind(site, before, rows_to_read(page));
  return make_page(all_versions(rows), page, kBaselineList,
                   [](const BaselineVersion& v) { return std::array{v.version}; });
}

Page<BaselineVersion> latest_baselines(const Snapshot& snapshot, const PageRequest& page) {
  const auto [after] = key_before<1>(page, kLatestList, {0});
  std::vector<BaselineVersion> latest;
  Statement sites(database_of(snapshot), "SELECT id FROM sites WHERE id > ? ORDER BY id");
  sites.bind(after);
  while (latest.size() < rows_to_read(page) && sites.next()) {
    if (auto version = latest_baseline(snapshot, sites.take<SiteId>())) latest.push_back(std::move(*version));
  }
  return make_page(std::move(latest), page, kLatestList,
                   [](const BaselineVersion& v) { return std::array{v.site.value}; });
}

std::vector<BaselineEntry> baseline_of_vantage(const Snapshot& snapshot, SiteId site, VantageId vantage) {
  Statement rows(database_of(snapshot),
                 kSelectEntries +
                     "INDEXED BY baseline_entries_now WHERE site = ? AND vantage = ? AND until_version IS "
                     "NULL AND min_x_m IS NULL ORDER BY id");
  rows.bind(site, vantage);
  return all_entries(rows);
}

std::vector<BaselineEntry> baseline_patches(const Snapshot& snapshot, SiteId site) {
  Statement rows(database_of(snapshot),
                 kSelectEntries +
                     "INDEXED BY baseline_patches_now WHERE site = ? AND until_version IS NULL AND "
                     "min_x_m IS NOT NULL ORDER BY id");
  rows.bind(site);
  return all_entries(rows);
}

bool is_in_baseline(const Snapshot& snapshot, ScanId scan) {
  return database_of(snapshot)
      .find<int>(
          "SELECT 1 FROM baseline_entries INDEXED BY baseline_entries_by_scan WHERE scan = ? AND until_version IS NULL",
          scan)
      .has_value();
}

}  // namespace raywatch
