#include "core/time.hpp"

#include <array>
#include <cstdio>

#include "core/error.hpp"

namespace raywatch {
namespace {

/// Reads an RFC 3339 text from left to right; every step either takes what it names or refuses the whole text.
class Rfc3339Parser {
 public:
  explicit Rfc3339Parser(std::string_view text) : text_(text), rest_(text) {}

  Time parse() {
    const int year = number(4);
    literal('-');
    const int month = number(2);
    literal('-');
    const int day = number(2);
    if (rest_.empty() || (rest_.front() != 'T' && rest_.front() != 't' && rest_.front() != ' ')) refuse();
    rest_.remove_prefix(1);
    const int hour = number(2);
    literal(':');
    const int minute = number(2);
    literal(':');
    const int second = number(2);
    const std::chrono::nanoseconds fraction = optional_fraction();
    const std::chrono::minutes offset = utc_offset();
    if (!rest_.empty()) refuse();

    const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    const bool leap_second = second == 60;
    if (!date.ok() || hour > 23 || minute > 59 || (second > 59 && !leap_second) || year < 1678 || year > 2261) refuse();
    return Time{std::chrono::sys_days{date}} + std::chrono::hours{hour} + std::chrono::minutes{minute} +
           std::chrono::seconds{second} + fraction - offset;
  }

 private:
  [[noreturn]] void refuse() const {
    throw InvalidInput("\"" + std::string(text_.substr(0, 64)) +
                       "\" is not a time; RFC 3339 is expected, such as 2026-03-01T02:10:00Z or "
                       "2026-03-01T02:10:00.25+01:00, between the years 1678 and 2261.");
  }

  int number(std::size_t digits) {
    if (rest_.size() < digits) refuse();
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      if (rest_[i] < '0' || rest_[i] > '9') refuse();
      value = value * 10 + (rest_[i] - '0');
    }
    rest_.remove_prefix(digits);
    return value;
  }

  void literal(char expected) {
    if (rest_.empty() || rest_.front() != expected) refuse();
    rest_.remove_prefix(1);
  }

  std::chrono::nanoseconds optional_fraction() {
    if (rest_.empty() || rest_.front() != '.') return {};
    rest_.remove_prefix(1);
    std::int64_t value = 0;
    std::size_t digits = 0;
    for (; !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; rest_.remove_prefix(1), ++digits) {
      if (digits < 9) value = value * 10 + (rest_.front() - '0');
    }
    if (digits == 0) refuse();
    for (; digits < 9; ++digits) value *= 10;
    return std::chrono::nanoseconds{value};
  }

  std::chrono::minutes utc_offset() {
    if (rest_.empty()) refuse();
    const char sign = rest_.front();
    rest_.remove_prefix(1);
    if (sign == 'Z' || sign == 'z') return {};
    if (sign != '+' && sign != '-') refuse();
    const int hours = number(2);
    literal(':');
    const int minutes = number(2);
    if (hours > 23 || minutes > 59) refuse();
    const std::chrono::minutes offset = std::chrono::hours{hours} + std::chrono::minutes{minutes};
    return sign == '+' ? offset : -offset;
  }

  std::string_view text_;
  std::string_view rest_;
};

}  // namespace

Duration between(Time from, Time to) {
  Duration::rep difference = 0;
  const bool reaches =
      !__builtin_sub_overflow(to.time_since_epoch().count(), from.time_since_epoch().count(), &difference);
  if (!reaches || Duration(difference) == Duration::min()) return to > from ? Duration::max() : -Duration::max();
  return Duration(difference);
}

Time shifted(Time time, Duration by) {
  Duration::rep sum = 0;
  if (__builtin_add_overflow(time.time_since_epoch().count(), by.count(), &sum)) {
    return by > Duration::zero() ? Time::max() : Time::min();
  }
  return Time(Duration(sum));
}

Time parse_rfc3339(std::string_view text) { return Rfc3339Parser(text).parse(); }

std::string format_rfc3339(Time time) {
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss clock{time - day};
  std::array<char, 48> buffer{};
  const int length =
      std::snprintf(buffer.data(), buffer.size(), "%04d-%02u-%02uT%02d:%02d:%02d.%09lld", static_cast<int>(date.year()),
                    static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                    static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                    static_cast<int>(clock.seconds().count()), static_cast<long long>(clock.subseconds().count()));
  std::string text(buffer.data(), static_cast<std::size_t>(length));
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text + "Z";
}

}  // namespace raywatch
