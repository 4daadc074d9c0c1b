#include "api/lookup.hpp"
#include "api/render.hpp"

namespace raywatch {

Json render_figures(const Change& change, const Eigen::Vector3d& origin_m) {
  const Pose world_from_box{change.box.world_from_box, change.box.center_m + origin_m};
  Json box = render(world_from_box);
  box["size_m"] = render(change.box.size_m);
  const Confidence& confidence = change.confidence;
  return {{"kind", to_string(change.kind)},
          {"centroid_m", render(Eigen::Vector3d(change.centroid_m + origin_m))},
          {"size_m", render(change.box.size_m)},
          {"volume_m3", change.volume_m3},
          {"box", std::move(box)},
          {"bounds_m",
           {{"min", render(Eigen::Vector3d(change.bounds_m.min() + origin_m))},
            {"max", render(Eigen::Vector3d(change.bounds_m.max() + origin_m))}}},
          {"points", change.points},
          {"confidence",
           {{"value", confidence.value},
            {"free", confidence.free},
            {"supported", confidence.supported},
            {"unknown", confidence.unknown}}}};
}

Json render(const Snapshot& snapshot, const ChangeRecord& record) {
  const Site site = site_with(snapshot, record.site);
  Json json = {{"id", record.id.value},     {"comparison", record.comparison.value},
               {"place", record.place},     {"site", site.name},
               {"scan", record.scan.value}, {"captured_at", format_rfc3339(record.captured_at)}};
  json.update(render_figures(record.change, origin_of(site)));
  json["track"] = id_or_null(record.track);
  return json;
}

}  // namespace raywatch
