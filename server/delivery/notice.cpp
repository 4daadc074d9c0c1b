#include "server/delivery/notice.hpp"

#include "api/lookup.hpp"
#include "api/render.hpp"
#include "core/error.hpp"
#include "storage/events.hpp"
#include "storage/local_time.hpp"

namespace raywatch {
namespace {

Json link_to(const std::string& public_url, const std::string& path) {
  return public_url.empty() ? Json(nullptr) : Json(public_url + path);
}

AlertHistoryStep step_of(const Snapshot& snapshot, AlertId alert, std::int64_t place) {
  const std::vector<AlertHistoryStep> steps = alert_history(snapshot, alert);
  if (place >= static_cast<std::int64_t>(steps.size())) throw NotFound("the step of the alert was deleted");
  return steps[static_cast<std::size_t>(place)];
}

/// Others may have followed before this step is sent.
AlertRecord as_after(AlertRecord alert, const AlertHistoryStep& step) {
  alert.state = step.state;
  alert.severity = step.severity;
  alert.edited_at = step.at;
  if (alert.state != AlertState::snoozed) alert.snoozed_until.reset();
  return alert;
}

Json alert_data(const Snapshot& snapshot, const DeliveryRecord& delivery, const std::string& public_url) {
  const AlertRecord alert = alert_with(snapshot, *delivery.alert);
  const AlertHistoryStep step = step_of(snapshot, alert.id, *delivery.step);
  const Site site = site_with(snapshot, alert.site);
  Json data = render(snapshot, as_after(alert, step));
  const auto zone = alert.zone ? find_zone(snapshot, *alert.zone) : std::nullopt;
  const auto track = alert.track ? find_track(snapshot, *alert.track) : std::nullopt;
  data["step"] = render(step);
  data["zone_name"] = zone ? Json(zone->name) : Json(nullptr);
  data["change"] = track ? render_figures(track->track.latest, origin_of(site)) : Json(nullptr);
  data["local_time"] = local_text(step.at, site.time_zone);
  data["link"] = link_to(public_url, "/alerts/" + std::to_string(alert.id.value));
  return data;
}

Json event_data(const Snapshot& snapshot, const Event& event, const std::string& public_url) {
  Json data = render(snapshot, event);
  data["link"] = link_to(public_url, "/api/v1/events/log?limit=1&after=" + std::to_string(event.id.value - 1));
  return data;
}

}  // namespace

std::string compose_notice(const Snapshot& snapshot, const DeliveryRecord& delivery, const std::string& public_url) {
  const std::optional<Event> event = find_event(snapshot, delivery.event);
  if (!event) throw NotFound("the event was deleted");
  return to_json_text({{"type", event->type},
                       {"timestamp", format_rfc3339(event->at)},
                       {"data", delivery.alert && delivery.step ? alert_data(snapshot, delivery, public_url)
                                                                : event_data(snapshot, *event, public_url)}});
}

std::string compose_test(const ChannelRecord& channel, Time now) {
  return to_json_text(
      {{"type", "test"},
       {"timestamp", format_rfc3339(now)},
       {"data", {{"channel", channel.name}, {"text", "This is a test of channel " + channel.name + "."}}}});
}

}  // namespace raywatch
