#include "storage/calendar.hpp"

#include <cstdio>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"

namespace raywatch::endpoints {
namespace {

constexpr std::chrono::days kLongestRange{400};

/// "2026-03-01".
std::string date_text(std::chrono::year_month_day date) {
  char text[16];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()));
  return text;
}

Json render_day(const CalendarDay& day, const SpanCounts& counts) {
  return {{"date", date_text(day.date)}, {"from", format_rfc3339(day.from)}, {"to", format_rfc3339(day.to)},
          {"scans", counts.scans},       {"tracks", counts.tracks},          {"alerts", counts.alerts}};
}

}  // namespace

HttpAnswer get_calendar(Call& call) {
  for (const char* name : {"site", "from", "to"}) call.query.require(name);
  const auto site_name = call.query.text("site");
  const TimeRange range = call.query.time_range();
  if (range.from && range.to && between(*range.from, *range.to) > kLongestRange)
    call.query.fail("to", "must be at most 400 days after 'from'");
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    const Site site = site_named(snapshot, *site_name);
    Json days = Json::array();
    for (const CalendarDay& day : days_between(*range.from, *range.to, site.time_zone)) {
      days.push_back(render_day(day, counts_between(snapshot, site.id, day.from, day.to)));
    }
    return Json{{"site", site.name}, {"time_zone", site.time_zone}, {"days", std::move(days)}};
  }));
}

}  // namespace raywatch::endpoints
