#include "storage/calendar.hpp"

#include "storage/local_time.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

std::uint64_t count_of(const Snapshot& snapshot, const std::string& rows, SiteId site, Time from, Time to) {
  return database_of(snapshot).find<std::uint64_t>("SELECT count(*) FROM " + rows, site, from, to).value();
}

}  // namespace

std::vector<CalendarDay> days_between(Time from, Time to, const std::string& time_zone) {
  const ZoneClock zone = zone_clock(time_zone);
  const auto start_of = [&](std::chrono::local_days day) { return zone.to_utc(LocalSeconds(day)); };
  std::vector<CalendarDay> days;
  for (auto day = std::chrono::floor<std::chrono::days>(zone.to_local(from)); start_of(day) < to;
       day += std::chrono::days(1)) {
    days.push_back(
        {.date = std::chrono::year_month_day(day), .from = start_of(day), .to = start_of(day + std::chrono::days(1))});
  }
  return days;
}

SpanCounts counts_between(const Snapshot& snapshot, SiteId site, Time from, Time to) {
  const auto count = [&](const std::string& rows) { return count_of(snapshot, rows, site, from, to); };
  return {.scans = count("scans INDEXED BY scans_by_site WHERE site = ? AND captured_at >= ? AND captured_at < ?"),
          .tracks = count(
              "tracks INDEXED BY tracks_by_first_seen WHERE site = ? AND first_seen_at >= ? AND first_seen_at < ?"),
          .alerts = count("alerts INDEXED BY alerts_by_opening WHERE site = ? AND opened_at >= ? AND opened_at < ?")};
}

}  // namespace raywatch
