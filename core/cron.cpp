#include "core/cron.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace raywatch {
namespace {

namespace chrono = std::chrono;

constexpr std::array<std::string_view, 12> kMonths{"jan", "feb", "mar", "apr", "may", "jun",
                                                   "jul", "aug", "sep", "oct", "nov", "dec"};
constexpr std::array<std::string_view, 7> kCronWeekdays{"sun", "mon", "tue", "wed", "thu", "fri", "sat"};
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kWords{{{"@hourly", "0 * * * *"},
                                                                               {"@daily", "0 0 * * *"},
                                                                               {"@midnight", "0 0 * * *"},
                                                                               {"@weekly", "0 0 * * 0"},
                                                                               {"@monthly", "0 0 1 * *"},
                                                                               {"@yearly", "0 0 1 1 *"},
                                                                               {"@annually", "0 0 1 1 *"}}};

/// A field of an expression, and what it may hold.
struct FieldKind {
  const char* name;
  unsigned least;
  unsigned most;
  std::span<const std::string_view> names = {};  ///< of the values from `least` on
};

constexpr std::array<FieldKind, 5> kFields{{{"minute", 0, 59},
                                            {"hour", 0, 23},
                                            {"day of the month", 1, 31},
                                            {"month", 1, 12, kMonths},
                                            {"day of the week", 0, 7, kCronWeekdays}}};

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("The schedule is no cron expression: " + what, {{"cron", what}});
}

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find_first_of(separators);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return result;
}

/// Reads one field of an expression.
class FieldParser {
 public:
  explicit FieldParser(const FieldKind& kind) : kind_(kind) {}

  std::bitset<64> parse(std::string_view text) const {
    std::bitset<64> values;
    for (const std::string_view item : split(text, ",")) add(item, values);
    return values;
  }

 private:
  void add(std::string_view item, std::bitset<64>& values) const {
    const std::size_t slash = item.find('/');
    const std::string_view range = item.substr(0, slash);
    const std::size_t dash = range.find('-');
    unsigned from = kind_.least, to = kind_.most;
    if (range != "*") {
      from = value(range.substr(0, dash));
      to = dash == std::string_view::npos ? from : value(range.substr(dash + 1));
      if (from > to) wrong(item, "the range runs backwards");
    }
    unsigned step = 1;
    if (slash != std::string_view::npos) {
      if (range != "*" && dash == std::string_view::npos) wrong(item, "a step needs * or a range before it");
      step = number(item.substr(slash + 1));
      if (step == 0) wrong(item, "a step must be at least 1");
    }
    for (unsigned i = from; i <= to; i += step) values.set(i);
  }

  unsigned value(std::string_view text) const {
    const auto named = std::ranges::find(kind_.names, std::string_view(lower(text)));
    if (named != kind_.names.end()) return kind_.least + static_cast<unsigned>(named - kind_.names.begin());
    const unsigned result = number(text);
    if (result < kind_.least || result > kind_.most) {
      wrong(text, "must be " + std::to_string(kind_.least) + " to " + std::to_string(kind_.most));
    }
    return result;
  }

  unsigned number(std::string_view text) const {
    const bool digits = std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
    if (text.empty() || text.size() > 3 || !digits) wrong(text, "is no value");
    return static_cast<unsigned>(std::stoul(std::string(text)));
  }

  [[noreturn]] void wrong(std::string_view text, const std::string& why) const {
    refuse(std::string(kind_.name) + ": \"" + std::string(text.substr(0, 64)) + "\": " + why);
  }

  const FieldKind& kind_;
};

template <std::size_t N>
std::bitset<N> narrowed(const std::bitset<64>& values) {
  return std::bitset<N>(values.to_ullong());
}

bool matches_day(const CronExpression& cron, chrono::local_days day) {
  const chrono::year_month_day date(day);
  if (!cron.months[static_cast<unsigned>(date.month())]) return false;
  const bool of_month = cron.days[static_cast<unsigned>(date.day())];
  const bool of_week = cron.weekdays[chrono::weekday(day).c_encoding()];
  return cron.either_day ? of_month || of_week : of_month && of_week;
}

/// The first time of a day that is not before `from_minute`.
std::optional<unsigned> minute_in_day(const CronExpression& cron, unsigned from_minute) {
  for (unsigned hour = from_minute / 60; hour < 24; ++hour) {
    if (!cron.hours[hour]) continue;
    for (unsigned minute = hour == from_minute / 60 ? from_minute % 60 : 0; minute < 60; ++minute) {
      if (cron.minutes[minute]) return 60 * hour + minute;
    }
  }
  return std::nullopt;
}

void check_days(const CronExpression& cron) {
  constexpr std::array<unsigned, 13> kLongest{0, 31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (cron.either_day) return;
  for (unsigned month = 1; month <= 12; ++month) {
    for (unsigned day = 1; cron.months[month] && day <= kLongest[month]; ++day) {
      if (cron.days[day]) return;
    }
  }
  refuse("day of the month: none of the months has such a day");
}

}  // namespace

CronExpression parse_cron(std::string_view text) {
  const auto word =
      std::ranges::find(kWords, std::string_view(lower(text)), [](const auto& pair) { return pair.first; });
  if (word != kWords.end()) return parse_cron(word->second);
  if (text.starts_with('@')) {
    refuse("known words are @hourly, @daily, @midnight, @weekly, @monthly, @yearly and @annually");
  }
  std::vector<std::string_view> fields = split(text, " \t");
  std::erase(fields, std::string_view());
  if (fields.size() != kFields.size()) {
    refuse("it must have five fields: minute, hour, day of the month, month, day of the week");
  }
  std::array<std::bitset<64>, kFields.size()> values;
  for (std::size_t i = 0; i < kFields.size(); ++i) values[i] = FieldParser(kFields[i]).parse(fields[i]);
  if (values[4][7]) values[4].set(0).reset(7);
  CronExpression cron{.minutes = narrowed<60>(values[0]),
                      .hours = narrowed<24>(values[1]),
                      .days = narrowed<32>(values[2]),
                      .months = narrowed<13>(values[3]),
                      .weekdays = narrowed<7>(values[4]),
                      .either_day = !fields[2].starts_with('*') && !fields[4].starts_with('*')};
  check_days(cron);
  return cron;
}

std::optional<LocalMinutes> next_local(const CronExpression& cron, LocalMinutes after) {
  constexpr int kMostDays = 30 * 366;
  const LocalMinutes first = after + chrono::minutes(1);
  chrono::local_days day = chrono::floor<chrono::days>(first);
  auto from = static_cast<unsigned>((first - day).count());
  for (int i = 0; i < kMostDays; ++i, day += chrono::days(1), from = 0) {
    if (!matches_day(cron, day)) continue;
    if (const auto minute = minute_in_day(cron, from)) return day + chrono::minutes(*minute);
  }
  return std::nullopt;
}

std::optional<Time> next_run(const CronExpression& cron, const ZoneClock& zone, Time after) {
  // Local times that come for the second time are named already: they lie before `after` and are passed over.
  LocalMinutes local = chrono::floor<chrono::minutes>(zone.to_local(after));
  while (const auto next = next_local(cron, local)) {
    const Time run = zone.to_utc(*next);
    if (run > after) return run;
    local = *next;
  }
  return std::nullopt;
}

std::vector<Time> runs_between(const CronExpression& cron, const ZoneClock& zone, Time after, Time until,
                               std::size_t most) {
  std::vector<Time> runs;
  while (runs.size() < most) {
    const std::optional<Time> run = next_run(cron, zone, after);
    if (!run || *run > until) break;
    runs.push_back(*run);
    after = *run;
  }
  return runs;
}

}  // namespace raywatch
