#include "storage/tracks.hpp"

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"

namespace raywatch::endpoints {

HttpAnswer list_tracks(Call& call) {
  const auto site_name = call.query.text("site");
  TrackFilter filter;
  filter.state = call.query.parsed("state", parse_track_state);
  filter.kind = call.query.parsed("kind", parse_change_kind);
  const TimeRange range = call.query.time_range();
  filter.from = range.from;
  filter.to = range.to;
  const PageRequest page = call.query.page();
  call.query.finish();
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    if (site_name) filter.site = site_named(snapshot, *site_name).id;
    return render_page(raywatch::list_tracks(snapshot, filter, page),
                       [&](const TrackRecord& track) { return render(snapshot, track); });
  }));
}

HttpAnswer get_track(Call& call) {
  call.query.finish();
  const auto id = id_in_path<TrackId>(call.path[0]);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    Json json = render(snapshot, track_with(snapshot, id));
    Json observations = Json::array();
    for (const SightRun& run : sight_runs(snapshot, id)) observations.push_back(render(run));
    json["observations"] = std::move(observations);
    Json alerts = Json::array();
    for (const AlertRecord& alert : alerts_of(snapshot, id)) alerts.push_back(render(snapshot, alert));
    json["alerts"] = std::move(alerts);
    return json;
  }));
}

HttpAnswer list_track_changes(Call& call) {
  const PageRequest page = call.query.page();
  call.query.finish();
  const auto id = id_in_path<TrackId>(call.path[0]);
  return json_answer(call.services.store.read([&](const Snapshot& snapshot) {
    ChangeFilter filter;
    filter.track = track_with(snapshot, id).track.id;
    filter.watching = true;
    return render_page(raywatch::list_changes(snapshot, filter, page),
                       [&](const ChangeRecord& change) { return render(snapshot, change); });
  }));
}

}  // namespace raywatch::endpoints
