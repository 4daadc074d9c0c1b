#include "storage/sites.hpp"

#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kSiteList = "sites";
const std::string kSelectSites =
    "SELECT id, name, time_zone, profile, epsg, mine_grid, origin_x_m, origin_y_m, origin_z_m, "
    "retention_max_age_days, retention_max_bytes, retention_min_free_bytes, created_at FROM sites ";

std::optional<Eigen::Vector3d> take_origin(Statement& row) {
  const auto x = row.take<std::optional<double>>();
  const auto y = row.take<std::optional<double>>();
  const auto z = row.take<std::optional<double>>();
  if (!x || !y || !z) return std::nullopt;
  return Eigen::Vector3d(*x, *y, *z);
}

using Json = nlohmann::json;

std::optional<std::string> text_of(const std::optional<MineGrid>& grid) {
  if (!grid) return std::nullopt;
  const Eigen::Vector3d &site = grid->site_origin_m, &mine = grid->grid_origin_m;
  return Json{{"site_origin_m", {site.x(), site.y(), site.z()}},
              {"grid_origin_m", {mine.x(), mine.y(), mine.z()}},
              {"rotation_rad", grid->rotation_rad},
              {"scale", grid->scale}}
      .dump();
}

std::optional<MineGrid> grid_of(const std::optional<std::string>& text) {
  if (!text) return std::nullopt;
  try {
    const Json json = Json::parse(*text);
    const auto place = [&](const char* name) {
      return Eigen::Vector3d(json.at(name).at(0), json.at(name).at(1), json.at(name).at(2));
    };
    return MineGrid{.site_origin_m = place("site_origin_m"),
                    .grid_origin_m = place("grid_origin_m"),
                    .rotation_rad = json.at("rotation_rad"),
                    .scale = json.at("scale")};
  } catch (const Json::exception& error) {
    throw CorruptData(std::string("the store holds a broken mine grid: ") + error.what());
  }
}

void check_coordinates(const Site& site) {
  if (site.mine_grid) check_grid(*site.mine_grid);
  if (!site.epsg || !site.mine_grid) return;
  throw InvalidInput("Results of a site go out in one kind of coordinates.",
                     {{"mine_grid", "cannot be given beside 'epsg': give null for the one that does not hold"}});
}

Site read_site(Statement& row) {
  Site site;
  site.id = row.take<SiteId>();
  site.name = row.take<std::string>();
  site.time_zone = row.take<std::string>();
  site.profile = enum_from_text(row.take<std::string>(), {Profile::indoor, Profile::outdoor, Profile::survey});
  site.epsg = row.take<std::optional<int>>();
  site.mine_grid = grid_of(row.take<std::optional<std::string>>());
  site.origin_m = take_origin(row);
  site.retention.max_age_days = row.take<std::optional<std::uint64_t>>();
  site.retention.max_bytes = row.take<std::optional<std::uint64_t>>();
  site.retention.min_free_bytes = row.take<std::optional<std::uint64_t>>();
  site.created_at = row.take<Time>();
  return site;
}

template <class Value>
std::optional<Site> find_site_by(const Snapshot& snapshot, std::string_view column, const Value& key) {
  Statement row(database_of(snapshot), kSelectSites + "WHERE " + std::string(column) + " = ?");
  if (!row.bind(key).next()) return std::nullopt;
  return read_site(row);
}

Site existing_site(const Snapshot& snapshot, SiteId id) {
  std::optional<Site> site = find_site(snapshot, id);
  if (!site) throw NotFound("there is no site " + std::to_string(id.value));
  return std::move(*site);
}

std::optional<double> coordinate(const std::optional<Eigen::Vector3d>& place, int axis) {
  return place ? std::optional((*place)[axis]) : std::nullopt;
}

bool has_places(const Snapshot& snapshot, SiteId id) {
  Database& database = database_of(snapshot);
  return database.find<int>("SELECT 1 FROM scans WHERE site = ? LIMIT 1", id).has_value() ||
         database.find<int>("SELECT 1 FROM zones WHERE site = ? LIMIT 1", id).has_value();
}

/// Without sensors nothing of it can be asked any more but by its id.
void delete_what_was_watched(Database& database, SiteId id) {
  for (const char* part : {"sight_runs WHERE track IN (SELECT id FROM tracks WHERE site = ?)",
                           "zone_coverage WHERE zone IN (SELECT id FROM zones WHERE site = ?)",
                           "alert_steps WHERE alert IN (SELECT id FROM alerts WHERE site = ?)",
                           "survey_levels WHERE schedule IN (SELECT id FROM schedules WHERE site = ?)",
                           "epoch_scans WHERE epoch IN (SELECT id FROM epochs WHERE site = ?)"}) {
    database.run(std::string("DELETE FROM ") + part, id);
  }
  for (const char* table : {"survey_figures", "surveys", "epochs", "survey_runs", "schedules", "tracks",
                            "watched_scans", "alerts", "silences", "rules", "zones", "baseline_entries", "baselines"}) {
    database.run(std::string("DELETE FROM ") + table + " WHERE site = ?", id);
  }
}

}  // namespace

Site insert_site(Transaction& transaction, const Site& site, Time now) {
  transaction.impl().require_room_for_records();
  check_coordinates(site);
  if (find_site(transaction, site.name)) throw Conflict("there is a site named \"" + site.name + "\" already");
  database_of(transaction)
      .run(
          "INSERT INTO sites (name, time_zone, profile, epsg, mine_grid, origin_x_m, origin_y_m, origin_z_m, "
          "retention_max_age_days, retention_max_bytes, retention_min_free_bytes, created_at) "
          "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          site.name, site.time_zone, to_string(site.profile), site.epsg, text_of(site.mine_grid),
          coordinate(site.origin_m, 0), coordinate(site.origin_m, 1), coordinate(site.origin_m, 2),
          site.retention.max_age_days, site.retention.max_bytes, site.retention.min_free_bytes, now);
  return existing_site(transaction, SiteId{database_of(transaction).last_id()});
}

std::optional<Site> find_site(const Snapshot& snapshot, std::string_view name) {
  return find_site_by(snapshot, "name", name);
}

std::optional<Site> find_site(const Snapshot& snapshot, SiteId id) { return find_site_by(snapshot, "id", id); }

Page<Site> list_sites(const Snapshot& snapshot, const PageRequest& page) {
  const auto [after] = key_before<1>(page, kSiteList, {0});
  Statement rows(database_of(snapshot), kSelectSites + "WHERE id > ? ORDER BY id LIMIT ?");
  rows.bind(after, rows_to_read(page));
  std::vector<Site> sites;
  while (rows.next()) sites.push_back(read_site(rows));
  return make_page(std::move(sites), page, kSiteList, [](const Site& site) { return std::array{site.id.value}; });
}

Site edit_site(Transaction& transaction, SiteId id, const SiteEdit& edit) {
  Site site = existing_site(transaction, id);
  if (edit.origin_m && edit.origin_m != site.origin_m && has_places(transaction, id)) {
    throw Conflict("the origin of site \"" + site.name + "\" is fixed: what is stored is relative to it");
  }
  if (edit.time_zone) site.time_zone = *edit.time_zone;
  if (edit.profile) site.profile = *edit.profile;
  if (edit.epsg) site.epsg = *edit.epsg;
  if (edit.mine_grid) site.mine_grid = *edit.mine_grid;
  if (edit.origin_m) site.origin_m = edit.origin_m;
  if (edit.retention) site.retention = *edit.retention;
  check_coordinates(site);
  database_of(transaction)
      .run(
          "UPDATE sites SET time_zone = ?, profile = ?, epsg = ?, mine_grid = ?, origin_x_m = ?, origin_y_m = ?, "
          "origin_z_m = ?, "
          "retention_max_age_days = ?, retention_max_bytes = ?, retention_min_free_bytes = ? WHERE id = ?",
          site.time_zone, to_string(site.profile), site.epsg, text_of(site.mine_grid), coordinate(site.origin_m, 0),
          coordinate(site.origin_m, 1), coordinate(site.origin_m, 2), site.retention.max_age_days,
          site.retention.max_bytes, site.retention.min_free_bytes, id);
  return site;
}

OutputFrame output_frame(const Site& site) {
  return {.origin_m = site.origin_m.value_or(Eigen::Vector3d::Zero()), .epsg = site.epsg, .grid = site.mine_grid};
}

/// Coordinates up to this size keep a tenth of a millimetre in 32-bit floats well enough; larger ones, such as those of
/// map projections, need an origin.
constexpr double kFarFromZero_m = 10'000.0;

Site fix_origin(Transaction& transaction, const Site& site, const Eigen::Vector3d& place_m) {
  if (site.origin_m) return site;
  SiteEdit edit;
  edit.origin_m = place_m.norm() > kFarFromZero_m ? Eigen::Vector3d(place_m.array().round()) : Eigen::Vector3d::Zero();
  return edit_site(transaction, site.id, edit);
}

void delete_site(Transaction& transaction, SiteId id) {
  const Site site = existing_site(transaction, id);
  if (database_of(transaction).find<int>("SELECT 1 FROM sensors WHERE site = ? LIMIT 1", id)) {
    throw Conflict("site \"" + site.name + "\" still has sensors");
  }
  if (database_of(transaction).find<int>("SELECT 1 FROM channels WHERE site = ? LIMIT 1", id)) {
    throw Conflict("site \"" + site.name + "\" still has channels that tell of it");
  }
  delete_what_was_watched(database_of(transaction), id);
  database_of(transaction).run("DELETE FROM sites WHERE id = ?", id);
}

}  // namespace raywatch
