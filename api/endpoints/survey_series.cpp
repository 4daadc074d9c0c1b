#include "storage/survey_series.hpp"

#include "api/call.hpp"
#include "api/endpoints/survey_endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/render_survey.hpp"
#include "api/units.hpp"

namespace raywatch::endpoints {
namespace {

constexpr std::size_t kMostValues = 10'000;

struct GivenSeries {
  std::optional<std::string> site;
  std::optional<ScheduleId> schedule;
  std::optional<ZoneId> zone;
  SurveyFigure figure = SurveyFigure::net_m3;
  Time from = Time::min(), to = Time::max();
  std::optional<bool> cumulative;
  VelocityParameters velocity;
  ForecastParameters forecast;
};

bool parse_flag(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  throw InvalidInput("must be true or false");
}

GivenSeries parse_series(Query& query) {
  GivenSeries given;
  given.site = query.text("site");
  if (const auto schedule = query.integer("schedule", {.min = 1})) given.schedule = ScheduleId{*schedule};
  if (const auto zone = query.integer("zone", {.min = 1})) given.zone = ZoneId{*zone};
  given.figure = query.parsed("figure", parse_survey_figure).value_or(given.figure);
  const TimeRange range = query.time_range();
  given.from = range.from.value_or(given.from);
  given.to = range.to.value_or(given.to);
  given.cumulative = query.parsed("cumulative", parse_flag);
  if (const auto hours = query.real("window_h", {.min = 1.0, .max = 8784.0})) {
    given.velocity.window = duration_of_seconds(3600.0 * *hours);
  }
  given.forecast.least_per_day = query.real("least_per_day", {.min = 0.0}).value_or(0.0);
  if (!given.site && !given.schedule) query.fail("site", "must be given, or else 'schedule'");
  query.finish();
  return given;
}

/// Adds up what changed from night to night; values at one time count together.
std::vector<TrendValue> trend_of(const std::vector<SeriesValue>& values, bool cumulative) {
  std::vector<TrendValue> trend;
  double sum = 0.0;
  for (const SeriesValue& value : values) {
    sum = cumulative ? sum + value.figure.value : value.figure.value;
    if (!trend.empty() && trend.back().at == value.at) trend.pop_back();
    trend.push_back({value.at, sum});
  }
  return trend;
}

/// A slope may come towards the sensor or go away from it: its speed counts.
std::vector<Velocity> speeds_of(std::vector<Velocity> velocities) {
  for (Velocity& velocity : velocities) velocity.per_day = std::abs(velocity.per_day);
  return velocities;
}

Json render_value(const SeriesValue& value, double trend) {
  return {{"survey", value.survey.value},
          {"at", format_rfc3339(value.at)},
          {"value", value.figure.value},
          {"low", json_or_null(value.figure.low)},
          {"high", json_or_null(value.figure.high)},
          {"trend", trend},
          {"level", value.level ? Json(to_string(*value.level)) : Json(nullptr)}};
}

Json render_velocity(const Velocity& velocity) {
  const Json inverse = velocity.per_day == 0.0 ? Json(nullptr) : Json(1.0 / std::abs(velocity.per_day));
  return {{"at", format_rfc3339(velocity.at)},
          {"per_day", velocity.per_day},
          {"sigma_per_day", velocity.sigma_per_day},
          {"inverse_days", inverse}};
}

Json render_forecast(const std::optional<FailureForecast>& forecast) {
  if (!forecast) return nullptr;
  return {{"at", format_rfc3339(forecast->at)},
          {"earliest", format_rfc3339(forecast->earliest)},
          {"latest", render(forecast->latest)},
          {"r_squared", forecast->r_squared},
          {"values", forecast->values}};
}

Json render_series(const std::vector<SeriesValue>& values, const GivenSeries& given, bool cumulative) {
  const std::vector<TrendValue> trend = trend_of(values, cumulative);
  const std::vector<Velocity> velocities = raywatch::velocities(trend, given.velocity);
  Json items = Json::array(), speeds = Json::array();
  std::size_t place = 0;
  for (const SeriesValue& value : values) {
    while (trend[place].at < value.at) ++place;
    items.push_back(render_value(value, trend[place].value));
  }
  for (const Velocity& velocity : velocities) speeds.push_back(render_velocity(velocity));
  return {{"figure", to_string(given.figure)},
          {"unit", unit_of(given.figure)},
          {"zone", id_or_null(given.zone)},
          {"schedule", id_or_null(given.schedule)},
          {"cumulative", cumulative},
          {"values", std::move(items)},
          {"velocities", std::move(speeds)},
          {"forecast", render_forecast(forecast_failure(speeds_of(velocities), given.forecast))}};
}

}  // namespace

HttpAnswer get_survey_series(Call& call) {
  const GivenSeries given = parse_series(call.query);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    SeriesKey key{.site = {}, .schedule = given.schedule, .zone = given.zone, .figure = given.figure};
    bool from_night_to_night = false;
    if (given.schedule) {
      const ScheduleRecord schedule = schedule_with(snapshot, *given.schedule);
      key.site = schedule.site;
      from_night_to_night = schedule.plan.definition.reference.policy == ReferencePolicy::previous;
    }
    if (given.site) key.site = site_named(snapshot, *given.site).id;
    const std::vector<SeriesValue> values = survey_series(snapshot, key, given.from, given.to, kMostValues);
    return render_series(values, given, given.cumulative.value_or(from_night_to_night));
  }));
}

}  // namespace raywatch::endpoints
