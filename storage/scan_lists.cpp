#include <algorithm>
#include <array>
#include <limits>
#include <unordered_set>

#include "storage/cursor.hpp"
#include "storage/scan_rows.hpp"
#include "storage/scans.hpp"
#include "storage/snapshot.hpp"
#include "storage/vantages.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kScanList = "scans";

using ScanKey = std::array<std::int64_t, 2>;  ///< captured_at, id
ScanKey key_of_scan(const ScanRecord& scan) { return {scan.captured_at.time_since_epoch().count(), scan.id.value}; }

/// The part of a list, newest first: from <= captured_at, and before a key.
struct ScanSpan {
  std::int64_t from;
  ScanKey before;  ///< captured_at < before[0], or equal and id < before[1]
  bool empty() const { return from > before[0]; }
};

ScanSpan span_of(const ScanFilter& filter, const PageRequest& page) {
  constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  const std::int64_t from = filter.from ? filter.from->time_since_epoch().count() : kMin;
  // Ids start at 1, so (to, 0) lies before every scan of that time.
  const ScanKey end = filter.to ? ScanKey{filter.to->time_since_epoch().count(), 0} : ScanKey{kMax, kMax};
  return {from, std::min(end, key_before(page, kScanList, ScanKey{kMax, kMax}))};
}

/// Which index serves a filter, and the columns that it fixes.
struct Access {
  std::string index;
  std::string equal;  ///< "column = ? AND ..."
  std::vector<std::int64_t> values;
};

Access access_of(const ScanFilter& filter) {
  if (filter.vantage && filter.sensor) {
    return {"scans_by_vantage_and_sensor",
            "vantage = ? AND sensor = ? AND ",
            {filter.vantage->value, filter.sensor->value}};
  }
  if (filter.vantage) return {"scans_by_vantage", "vantage = ? AND ", {filter.vantage->value}};
  if (filter.sensor) return {"scans_by_sensor", "sensor = ? AND ", {filter.sensor->value}};
  if (filter.site) return {"scans_by_site", "site = ? AND ", {filter.site->value}};
  return {"scans_by_time", "", {}};
}

std::string query(const std::string& select, const Access& access) {
  return select + "INDEXED BY " + access.index + " WHERE " + access.equal +
         "captured_at BETWEEN ? AND ? AND (captured_at < ? OR id < ?) ORDER BY captured_at DESC, id DESC LIMIT ?";
}

void bind(Statement& rows, const Access& access, const ScanSpan& span, std::size_t count) {
  for (const std::int64_t value : access.values) rows.bind(value);
  rows.bind(span.from, span.before[0], span.before[0], span.before[1], count);
}

/// A sensor and a vantage belong to one site each: asked for together with another site, they have no scans.
bool contradicts_site(const Snapshot& snapshot, const ScanFilter& filter) {
  if (!filter.site) return false;
  Database& database = database_of(snapshot);
  const bool sensor_differs =
      filter.sensor && database.find<SiteId>("SELECT site FROM sensors WHERE id = ?", *filter.sensor) != filter.site;
  const bool vantage_differs =
      filter.vantage && database.find<SiteId>("SELECT site FROM vantages WHERE id = ?", *filter.vantage) != filter.site;
  return sensor_differs || vantage_differs;
}

std::vector<ScanRecord> scans_by_index(const Snapshot& snapshot, const ScanFilter& filter, const ScanSpan& span,
                                       std::size_t count) {
  const Access access = access_of(filter);
  Statement rows(database_of(snapshot), query(select_scans(), access));
  bind(rows, access, span, count);
  std::vector<ScanRecord> scans;
  while (rows.next()) scans.push_back(read_scan(rows));
  return scans;
}

/// The keys of the newest scans of each vantage, merged. Right for few vantages with many scans.
std::vector<ScanKey> keys_by_vantage(const Snapshot& snapshot, ScanFilter filter,
                                     const std::vector<VantageDistance>& vantages, const ScanSpan& span,
                                     std::size_t count) {
  std::vector<ScanKey> keys;
  for (const VantageDistance& vantage : vantages) {
    filter.vantage = vantage.id;
    const Access access = access_of(filter);
    Statement rows(database_of(snapshot), query("SELECT captured_at, id FROM scans ", access));
    bind(rows, access, span, count);
    while (rows.next()) {
      const auto captured_at = rows.take<std::int64_t>();
      keys.push_back({captured_at, rows.take<std::int64_t>()});
    }
  }
  std::sort(keys.begin(), keys.end(), std::greater<>());
  keys.resize(std::min(keys.size(), count));
  return keys;
}

/// The keys of the newest scans of the site, or sensor, whose vantage is one of many.
std::vector<ScanKey> keys_by_time(const Snapshot& snapshot, const ScanFilter& filter,
                                  const std::vector<VantageDistance>& vantages, const ScanSpan& span,
                                  std::size_t count) {
  std::unordered_set<VantageId> wanted;
  for (const VantageDistance& vantage : vantages) wanted.insert(vantage.id);
  const Access access = access_of(filter);
  Statement rows(database_of(snapshot), query("SELECT captured_at, id, vantage FROM scans ", access));
  bind(rows, access, span, static_cast<std::size_t>(std::numeric_limits<std::int64_t>::max()));
  std::vector<ScanKey> keys;
  while (keys.size() < count && rows.next()) {
    const auto captured_at = rows.take<std::int64_t>();
    const auto id = rows.take<std::int64_t>();
    if (wanted.contains(rows.take<VantageId>())) keys.push_back({captured_at, id});
  }
  return keys;
}

/// From this number on it costs less to walk through time than to ask each vantage.
constexpr std::size_t kManyVantages = 500;

std::vector<ScanRecord> scans_near(const Snapshot& snapshot, const ScanFilter& filter, const ScanSpan& span,
                                   std::size_t count) {
  if (!filter.site) throw InvalidInput("a place needs a site", {{"near", "needs \"site\""}});
  std::vector<VantageDistance> vantages = vantages_within(snapshot, *filter.site, *filter.near_m, filter.near_radius_m);
  if (filter.vantage) std::erase_if(vantages, [&](const VantageDistance& v) { return v.id != *filter.vantage; });
  const std::vector<ScanKey> keys = vantages.size() < kManyVantages
                                        ? keys_by_vantage(snapshot, filter, vantages, span, count)
                                        : keys_by_time(snapshot, filter, vantages, span, count);
  std::vector<ScanRecord> scans;
  for (const ScanKey& key : keys) scans.push_back(find_scan(snapshot, ScanId{key[1]}).value());
  return scans;
}

}  // namespace

Page<ScanRecord> list_scans(const Snapshot& snapshot, const ScanFilter& filter, const PageRequest& page) {
  const std::size_t count = rows_to_read(page);
  const ScanSpan span = span_of(filter, page);
  if (span.empty() || contradicts_site(snapshot, filter)) return {};
  return make_page(
      filter.near_m ? scans_near(snapshot, filter, span, count) : scans_by_index(snapshot, filter, span, count), page,
      kScanList, key_of_scan);
}

std::optional<ScanRecord> latest_scan(const Snapshot& snapshot, VantageId vantage, Time not_before, Time before) {
  Statement row(database_of(snapshot), select_scans() +
                                           "INDEXED BY scans_by_vantage WHERE vantage = ? AND captured_at >= ? AND "
                                           "captured_at < ? ORDER BY captured_at DESC, id DESC LIMIT 1");
  if (!row.bind(vantage, not_before, before).next()) return std::nullopt;
  return read_scan(row);
}

std::optional<ScanRecord> find_anchor(const Snapshot& snapshot, VantageId vantage) {
  Statement row(database_of(snapshot), select_scans() +
                                           "INDEXED BY anchors_by_vantage WHERE vantage = ? AND registration_state = "
                                           "'none' AND registration_uncertainty_m IS NOT NULL "
                                           "ORDER BY captured_at, id LIMIT 1");
  if (!row.bind(vantage).next()) return std::nullopt;
  return read_scan(row);
}

std::optional<ScanRecord> latest_registered(const Snapshot& snapshot, SensorId sensor, Time before) {
  Statement row(database_of(snapshot), select_scans() +
                                           "INDEXED BY scans_by_sensor WHERE sensor = ? AND captured_at < ? AND "
                                           "registration_uncertainty_m IS NOT NULL "
                                           "ORDER BY captured_at DESC LIMIT 1");
  if (!row.bind(sensor, before).next()) return std::nullopt;
  return read_scan(row);
}

}  // namespace raywatch
