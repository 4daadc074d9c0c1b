#include "storage/events.hpp"

#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/stream_slots.hpp"
#include "storage/signal.hpp"

namespace raywatch::endpoints {
namespace {

constexpr std::size_t kBatch = 500;
/// So often a client that hears nothing is told that the stream still stands; and so long it takes at most until one
/// that went away is noticed.
constexpr std::chrono::seconds kHeartbeat{15}, kPatience{1};

std::optional<SiteId> site_of(const Services& services, const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  return services.store.read([&](const Snapshot& snapshot) { return site_named(snapshot, *name).id; });
}

/// Where a stream begins: behind the event that the client had last, else with what happens from now on.
EventId start_of(const Call& call, std::optional<std::int64_t> after) {
  if (const auto last = call.header("Last-Event-ID")) {
    const auto id = parse_integer(*last);
    if (!id || *id < 0) throw InvalidInput("Last-Event-ID is no event's id.", {{"Last-Event-ID", "must be an id"}});
    return EventId{*id};
  }
  if (after) return EventId{*after};
  return call.services.store.read([](const Snapshot& snapshot) { return last_event(snapshot); });
}

/// What a client asks for and the store does not have any more.
struct Gap {
  EventId resume;    ///< the stream goes on behind it
  std::string text;  ///< for people
};

/// Nothing is left out without a word: events are kept for a time only, and a store that was put back from a backup
/// knows less than its clients.
std::optional<Gap> gap_behind(const Snapshot& snapshot, EventId after) {
  const EventId first = first_event(snapshot), last = last_event(snapshot);
  if (after.value + 1 < first.value) {
    return Gap{EventId{first.value - 1}, "The events from " + std::to_string(after.value + 1) + " to " +
                                             std::to_string(first.value - 1) +
                                             " are not kept any more; read anew what is shown."};
  }
  if (after > last) {
    return Gap{last, "There is no event " + std::to_string(after.value) + ", the latest is " +
                         std::to_string(last.value) +
                         ": the store was put back to an earlier state; read anew what is shown."};
  }
  return std::nullopt;
}

Json render_gap(const Gap& gap, EventId after) {
  return {{"id", gap.resume.value}, {"type", "gap"}, {"after", after.value}, {"text", gap.text}};
}

/// One client's stream: what is in the store and not yet sent, again and again.
class EventStream {
 public:
  EventStream(const Services& services, std::function<bool()> abandoned, EventId after, std::optional<SiteId> site)
      : store_(services.store), abandoned_(std::move(abandoned)), last_(after), site_(site) {}

  void write_to(std::ostream& out) {
    Signal& commits = store_.commits();
    auto silent_since = Signal::Clock::now();
    out << ": from event " << last_.value << "\n\n" << std::flush;
    while (out && !abandoned_() && !commits.is_closed()) {
      const std::uint64_t seen = commits.generation();
      const bool sent = send_new(out);
      const auto now = Signal::Clock::now();
      if (!sent && now - silent_since >= kHeartbeat) out << ": still here\n\n" << std::flush;
      if (sent || now - silent_since >= kHeartbeat) silent_since = now;
      if (!sent) commits.wait_past(seen, now + kPatience);
    }
  }

 private:
  /// Nothing of the store is held while it is sent: a client that does not take it must not keep others waiting.
  bool send_new(std::ostream& out) {
    const std::string text = store_.read([&](const Snapshot& snapshot) { return next_batch(snapshot); });
    out << text;
    return !text.empty() && out.flush();
  }

  std::string next_batch(const Snapshot& snapshot) {
    std::string text;
    const auto add = [&](EventId id, const std::string& type, const Json& data) {
      text += "id: " + std::to_string(id.value) + "\nevent: " + type + "\ndata: " + to_json_text(data) + "\n\n";
      last_ = id;
    };
    if (const std::optional<Gap> gap = gap_behind(snapshot, last_)) add(gap->resume, "gap", render_gap(*gap, last_));
    for (const Event& event : events_after(snapshot, last_, site_, kBatch)) {
      add(event.id, event.type, render(snapshot, event));
    }
    return text;
  }

  Store& store_;
  std::function<bool()> abandoned_;
  EventId last_;
  std::optional<SiteId> site_;
};

}  // namespace

HttpAnswer stream_events(Call& call) {
  const auto site_name = call.query.text("site");
  const auto after = call.query.integer("after", {.min = 0});
  call.query.finish();
  const std::optional<SiteId> site = site_of(call.services, site_name);
  const EventId start = start_of(call, after);
  const auto slot = std::make_shared<StreamSlot>(call.streams);
  HttpAnswer answer;
  answer.content_type = "text/event-stream";
  answer.endless = true;
  answer.set_header("X-Accel-Buffering", "no");
  answer.stream = [&services = call.services, abandoned = call.abandoned, start, site, slot](std::ostream& out) {
    EventStream(services, abandoned, start, site).write_to(out);
  };
  return answer;
}

HttpAnswer list_events(Call& call) {
  const auto site_name = call.query.text("site");
  const auto given_after = call.query.integer("after", {.min = 0});
  const EventId after{given_after.value_or(0)};
  const auto limit = static_cast<std::size_t>(call.query.integer("limit", {.min = 1, .max = 1000}).value_or(100));
  call.query.finish();
  const std::optional<SiteId> site = site_of(call.services, site_name);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    std::vector<Event> events = events_after(snapshot, after, site, limit + 1);
    const bool more = events.size() > limit;
    if (more) events.resize(limit);
    Json items = Json::array();
    for (const Event& event : events) items.push_back(render(snapshot, event));
    const std::optional<Gap> gap = given_after ? gap_behind(snapshot, after) : std::nullopt;
    return Json{{"items", std::move(items)},
                {"gap", gap ? render_gap(*gap, after) : Json(nullptr)},
                {"next", more ? Json(std::to_string(events.back().id.value)) : Json(nullptr)}};
  }));
}

}  // namespace raywatch::endpoints
