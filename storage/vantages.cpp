#include "storage/vantages.hpp"

#include <algorithm>
#include <array>

#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/snapshot.hpp"
#include "storage/spatial.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kVantageList = "vantages";
const std::string kSelectVantages =
    "SELECT id, site, x_m, y_m, z_m, scans, first_captured_at, last_captured_at FROM vantages ";

Vantage read_vantage(Statement& row) {
  Vantage vantage;
  vantage.id = row.take<VantageId>();
  vantage.site = row.take<SiteId>();
  vantage.position_m = take_vector(row);
  vantage.scans = row.take<std::uint64_t>();
  vantage.first_captured_at = row.take<std::optional<Time>>();
  vantage.last_captured_at = row.take<std::optional<Time>>();
  return vantage;
}

bool is_nearer(const VantageDistance& a, const VantageDistance& b) {
  return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.id < b.id;
}

/// Whether a site has more than `limit` vantages; counts no further than that.
bool has_more_vantages_than(const Snapshot& snapshot, SiteId site, std::size_t limit) {
  const auto count = database_of(snapshot).find<std::size_t>(
      "SELECT count(*) FROM (SELECT 1 FROM vantages INDEXED BY vantages_by_site WHERE site = ? LIMIT ?)", site,
      limit + 1);
  return count.value_or(0) > limit;
}

std::vector<VantageDistance> all_vantages(const Snapshot& snapshot, SiteId site, const Eigen::Vector3d& position_m) {
  Statement rows(database_of(snapshot),
                 "SELECT id, x_m, y_m, z_m FROM vantages INDEXED BY vantages_by_site WHERE site = ?");
  rows.bind(site);
  std::vector<VantageDistance> found;
  while (rows.next()) {
    const auto id = rows.take<VantageId>();
    found.push_back({id, (take_vector(rows) - position_m).norm()});
  }
  return found;
}

/// At least `limit` vantages of a site that has more than that, among them the nearest ones: a ball that grows until it
/// holds enough.
std::vector<VantageDistance> enough_vantages(const Snapshot& snapshot, SiteId site, const Eigen::Vector3d& position_m,
                                             std::size_t limit) {
  for (double radius_m = 1.0; std::isfinite(radius_m); radius_m *= 2.0) {
    std::vector<VantageDistance> found = vantages_within(snapshot, site, position_m, radius_m);
    if (found.size() >= limit) return found;
  }
  return all_vantages(snapshot, site, position_m);
}

VantageId insert_vantage(Transaction& transaction, SiteId site, const Eigen::Vector3d& place_m) {
  Database& database = database_of(transaction);
  database.run("INSERT INTO vantages (site, x_m, y_m, z_m, scans) VALUES (?, ?, ?, ?, 0)", site, place_m.x(),
               place_m.y(), place_m.z());
  const VantageId id{database.last_id()};
  const auto site_key = static_cast<double>(site.value);
  database.run("INSERT INTO vantage_places VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", id, tree_min(site_key),
               tree_max(site_key), tree_min(place_m.x()), tree_max(place_m.x()), tree_min(place_m.y()),
               tree_max(place_m.y()), tree_min(place_m.z()), tree_max(place_m.z()));
  return id;
}

}  // namespace

std::vector<VantageDistance> vantages_within(const Snapshot& snapshot, SiteId site, const Eigen::Vector3d& position_m,
                                             double radius_m) {
  Statement rows(database_of(snapshot),
                 "SELECT v.id, v.x_m, v.y_m, v.z_m FROM vantage_places AS p CROSS JOIN vantages AS v ON v.id = p.id "
                 "WHERE p.site_min <= ?1 AND p.site_max >= ?1 AND p.x_min <= ?2 AND p.x_max >= ?3 "
                 "AND p.y_min <= ?4 AND p.y_max >= ?5 AND p.z_min <= ?6 AND p.z_max >= ?7 AND v.site = ?1");
  rows.bind(site);
  for (int axis = 0; axis < 3; ++axis) rows.bind(position_m[axis] + radius_m, position_m[axis] - radius_m);
  std::vector<VantageDistance> found;
  while (rows.next()) {
    const auto id = rows.take<VantageId>();
    const double distance_m = (take_vector(rows) - position_m).norm();
    if (distance_m < radius_m) found.push_back({id, distance_m});
  }
  return found;
}

VantageId vantage_for_scan(Transaction& transaction, SiteId site, const Eigen::Vector3d& position_m) {
  const std::vector<VantageDistance> near = vantages_within(transaction, site, position_m, kVantageRadius_m);
  const auto nearest = std::min_element(near.begin(), near.end(), is_nearer);
  return nearest != near.end() ? nearest->id : insert_vantage(transaction, site, position_m);
}

void add_scan_to_vantage(Transaction& transaction, VantageId vantage, Time captured_at) {
  database_of(transaction)
      .run(
          "UPDATE vantages SET scans = scans + 1, first_captured_at = min(ifnull(first_captured_at, ?1), ?1), "
          "last_captured_at = max(ifnull(last_captured_at, ?1), ?1) WHERE id = ?2",
          captured_at, vantage);
}

void drop_scan_from_vantage(Transaction& transaction, VantageId vantage) {
  Database& database = database_of(transaction);
  database.run(
      "UPDATE vantages SET scans = scans - 1, "
      "first_captured_at = (SELECT min(captured_at) FROM scans INDEXED BY scans_by_vantage WHERE vantage = ?1), "
      "last_captured_at = (SELECT max(captured_at) FROM scans INDEXED BY scans_by_vantage WHERE vantage = ?1) "
      "WHERE id = ?1",
      vantage);
  database.run("DELETE FROM vantages WHERE id = ? AND scans = 0", vantage);
  if (database.changed_rows() > 0) database.run("DELETE FROM vantage_places WHERE id = ?", vantage);
}

Page<Vantage> list_vantages(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  const auto [after] = key_before<1>(page, kVantageList, {0});
  Statement rows(database_of(snapshot), kSelectVantages +
                                            (site ? "INDEXED BY vantages_by_site WHERE site = ? AND " : "WHERE ") +
                                            "id > ? ORDER BY id LIMIT ?");
  if (site) rows.bind(*site);
  rows.bind(after, rows_to_read(page));
  std::vector<Vantage> vantages;
  while (rows.next()) vantages.push_back(read_vantage(rows));
  return make_page(std::move(vantages), page, kVantageList, [](const Vantage& v) { return std::array{v.id.value}; });
}

std::vector<Vantage> nearest_vantages(const Snapshot& snapshot, SiteId site, const Eigen::Vector3d& position_m,
                                      std::size_t limit) {
  std::vector<VantageDistance> found = has_more_vantages_than(snapshot, site, limit)
                                           ? enough_vantages(snapshot, site, position_m, limit)
                                           : all_vantages(snapshot, site, position_m);
  const auto end = found.begin() + static_cast<std::ptrdiff_t>(std::min(limit, found.size()));
  std::partial_sort(found.begin(), end, found.end(), is_nearer);
  found.erase(end, found.end());
  std::vector<Vantage> vantages;
  for (const VantageDistance& near : found) {
    Statement one(database_of(snapshot), kSelectVantages + "WHERE id = ?");
    one.bind(near.id).next();
    vantages.push_back(read_vantage(one));
  }
  return vantages;
}

}  // namespace raywatch
