#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/rule.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// A zone as stored; its prism is local.
struct ZoneRecord {
  Zone zone;
  SiteId site;
  std::string name;
  Time created_at, edited_at;
};

/// @throws Conflict when the site has a zone of that name; NotFound for the site.
ZoneRecord insert_zone(Transaction& transaction, const ZoneRecord& zone, Time now);
std::optional<ZoneRecord> find_zone(const Snapshot& snapshot, ZoneId id);
std::optional<ZoneRecord> find_zone(const Snapshot& snapshot, SiteId site, std::string_view name);
/// Oldest first.
Page<ZoneRecord> list_zones(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);
std::vector<Zone> zones_of(const Snapshot& snapshot, SiteId site);
/// Replaces the name, kind and prism. Its coverage begins anew when the prism differs. @throws Conflict when the name
/// is taken.
ZoneRecord replace_zone(Transaction& transaction, const ZoneRecord& zone, Time now);
/// @throws Conflict while a rule looks into it.
void delete_zone(Transaction& transaction, ZoneId id);

/// How much of a zone one watched scan could judge.
struct ZoneCoverage {
  std::int64_t turn = 0;  ///< of the scan among those that were watched
  ScanId scan;
  SensorId sensor;
  VantageId vantage;
  Time captured_at;
  double share = 0.0;
};
void insert_coverage(Transaction& transaction, ZoneId zone, std::int64_t turn, double share);
/// What the tracked scans of a vantage could judge of a zone: the first `count` of them, or the last, newest first.
std::vector<double> first_coverage(const Snapshot& snapshot, ZoneId zone, VantageId vantage, std::size_t count);
std::vector<double> last_coverage(const Snapshot& snapshot, ZoneId zone, VantageId vantage, std::size_t count);
/// The latest watched first.
Page<ZoneCoverage> list_coverage(const Snapshot& snapshot, ZoneId zone, const PageRequest& page);

}  // namespace raywatch
