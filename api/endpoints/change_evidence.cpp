#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "api/call.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/point_set.hpp"
#include "api/render.hpp"
#include "core/look.hpp"
#include "core/proving_rays.hpp"
#include "storage/payloads.hpp"

namespace raywatch::endpoints {
namespace {

/// A scan that took part in the comparison.
struct Witness {
  ScanRecord scan;
  SensorModel sensor;
  std::int32_t prior = -1;  ///< its place among the priors; -1: the compared scan
  Pose local_from_sensor;
};

struct Case {
  ChangeRecord change;
  ComparisonRecord comparison;
  Site site;
  std::vector<Witness> witnesses;  ///< the compared scan first
  std::vector<ScanId> deleted;     ///< priors that are not stored any more
};

Witness witness_of(const Snapshot& snapshot, const ScanRecord& scan, const Site& site, std::int32_t prior) {
  const SensorModel known = find_sensor(snapshot, scan.sensor).value().known;
  return {scan, merged(known, scan.estimated), prior, local_pose(scan, site)};
}

Case read_case(const Snapshot& snapshot, ChangeId id) {
  Case read{.change = change_with(snapshot, id), .comparison = {}, .site = {}, .witnesses = {}, .deleted = {}};
  read.comparison = comparison_with(snapshot, read.change.comparison);
  read.site = site_with(snapshot, read.change.site);
  read.witnesses.push_back(witness_of(snapshot, scan_with(snapshot, read.comparison.scan), read.site, -1));
  for (std::size_t p = 0; p < read.comparison.priors.size(); ++p) {
    const ScanId prior = read.comparison.priors[p].scan;
    if (const auto scan = find_scan(snapshot, prior)) {
      read.witnesses.push_back(witness_of(snapshot, *scan, read.site, static_cast<std::int32_t>(p)));
    } else {
      read.deleted.push_back(prior);
    }
  }
  return read;
}

/// How much is told: points and rays beyond these numbers are left out evenly.
struct Extent {
  double margin_m = 1.0;
  std::size_t points = 2000, rays = 200;
};

/// The places in a scan of the points that belong to the change.
std::vector<std::uint8_t> members_of(const Witness& witness, const ComparisonPoints& result, std::int32_t change,
                                     std::size_t points) {
  std::vector<std::uint8_t> members(points, 0);
  const auto mark = [&](std::size_t i) {
    if (i >= points) throw CorruptData("A stored change names a point that its scan does not have.");
    members[i] = 1;
  };
  if (witness.prior < 0) {
    for (std::size_t i = 0; i < result.change_of.size(); ++i) {
      if (result.change_of[i] == change) mark(i);
    }
  } else {
    for (const PriorPoint& point : result.prior_points) {
      if (point.change == change && point.prior == static_cast<std::uint32_t>(witness.prior)) mark(point.index);
    }
  }
  return members;
}

/// Places, in the local frame, evenly thinned to a number.
class Places {
 public:
  void push_back(const Eigen::Vector3d& local_m) { local_m_.push_back(local_m); }
  std::size_t size() const { return local_m_.size(); }
  const std::vector<Eigen::Vector3d>& all() const { return local_m_; }

  Json render(std::size_t most, const Eigen::Vector3d& origin_m) const {
    constexpr double kPerMetre = 1e4;
    Json json = Json::array();
    const std::size_t step = (local_m_.size() + most - 1) / most;
    for (std::size_t k = 0; k < local_m_.size(); k += step) {
      const Eigen::Vector3d place_m = ((local_m_[k] + origin_m) * kPerMetre).array().round() / kPerMetre;
      json.push_back(raywatch::render(place_m));
    }
    return json;
  }

 private:
  std::vector<Eigen::Vector3d> local_m_;
};

/// What one scan shows of the change, and around it.
struct Shown {
  Places changed, around;
};

Shown shown_by(const Witness& witness, const PointCloud& points, const ComparisonPoints& result, const Case& about,
               double margin_m) {
  Eigen::AlignedBox3d surroundings = about.change.change.bounds_m;
  surroundings.extend(Eigen::Vector3d(surroundings.min().array() - margin_m));
  surroundings.extend(Eigen::Vector3d(surroundings.max().array() + margin_m));
  const std::vector<std::uint8_t> is_member = members_of(witness, result, about.change.place, points.size());
  Shown shown;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d local_m = witness.local_from_sensor * points[i].cast<double>();
    if (is_member[i]) {
      shown.changed.push_back(local_m);
    } else if (surroundings.contains(local_m) && is_usable(points[i].cast<double>().norm(), {})) {
      shown.around.push_back(local_m);
    }
  }
  return shown;
}

/// Where the rays of a scan ended that went where the changed points are.
Places rays_through(const Witness& witness, const PointCloud& points, const std::vector<Eigen::Vector3d>& changed_m,
                    const CompareParameters& parameters) {
  const Pose sensor_from_local = witness.local_from_sensor.inverse();
  PointCloud change;
  for (const Eigen::Vector3d& place_m : changed_m) {
    const Eigen::Vector3f p = (sensor_from_local * place_m).cast<float>();
    change.push_back(p.x(), p.y(), p.z());
  }
  Places ends;
  for (const std::uint32_t i : proving_rays(change, points, usable_range(witness.sensor, parameters),
                                            look_thresholds(witness.sensor, parameters))) {
    ends.push_back(witness.local_from_sensor * points[i].cast<double>());
  }
  return ends;
}

Json render_places(const Witness& witness, const Places& places, std::size_t most, const Eigen::Vector3d& origin_m) {
  return {{"scan", witness.scan.id.value}, {"count", places.size()}, {"positions_m", places.render(most, origin_m)}};
}

/// Rays are asked of the other side: of the priors about what the compared scan shows, and of it about what they show.
Json gather(const Payloads& payloads, const Case& about, const Extent& extent) {
  const ComparisonPoints result = payloads.comparison_points(about.comparison.payload);
  const Eigen::Vector3d origin_m = origin_of(about.site);
  std::vector<PointCloud> points;
  std::vector<Shown> shown;
  std::vector<Eigen::Vector3d> of_scan_m, of_priors_m;
  Json changed = Json::array(), around = Json::array(), rays = Json::array();
  for (const Witness& witness : about.witnesses) {
    points.push_back(payloads.scan_points(witness.scan.payload));
    shown.push_back(shown_by(witness, points.back(), result, about, extent.margin_m));
    const auto& changed_m = shown.back().changed.all();
    auto& side_m = witness.prior < 0 ? of_scan_m : of_priors_m;
    side_m.insert(side_m.end(), changed_m.begin(), changed_m.end());
    if (!changed_m.empty()) changed.push_back(render_places(witness, shown.back().changed, extent.points, origin_m));
    around.push_back(render_places(witness, shown.back().around, extent.points, origin_m));
  }
  for (std::size_t w = 0; w < about.witnesses.size(); ++w) {
    const Witness& witness = about.witnesses[w];
    const auto& asked_m = witness.prior < 0 ? of_priors_m : of_scan_m;
    if (asked_m.empty()) continue;
    const Places ends = rays_through(witness, points[w], asked_m, about.comparison.parameters);
    rays.push_back({{"scan", witness.scan.id.value},
                    {"from_m", render(Eigen::Vector3d(witness.local_from_sensor.position_m + origin_m))},
                    {"count", ends.size()},
                    {"to_m", ends.render(extent.rays, origin_m)}});
  }
  Json deleted = Json::array();
  for (const ScanId scan : about.deleted) deleted.push_back(scan.value);
  return {{"change", about.change.id.value},
          {"site", about.site.name},
          {"kind", to_string(about.change.change.kind)},
          {"changed", std::move(changed)},
          {"surroundings", std::move(around)},
          {"rays", std::move(rays)},
          {"deleted_scans", std::move(deleted)}};
}

Extent parse_extent(Query& query) {
  constexpr double kMostMargin_m = 20.0;
  constexpr std::int64_t kMost = 20'000;
  Extent extent;
  extent.margin_m = query.real("margin_m", {.min = 0.0, .max = kMostMargin_m}).value_or(extent.margin_m);
  const auto count = [&](const char* name, std::size_t usual) {
    const auto given = query.integer(name, {.min = 1, .max = kMost});
    return given ? static_cast<std::size_t>(*given) : usual;
  };
  extent.points = count("points", extent.points);
  extent.rays = count("rays", extent.rays);
  return extent;
}

}  // namespace

HttpAnswer get_change_evidence(Call& call) {
  const Extent extent = parse_extent(call.query);
  call.query.finish();
  const auto id = id_in_path<ChangeId>(call.path[0]);
  const Case about = call.services.store.read([&](const Snapshot& snapshot) { return read_case(snapshot, id); });
  return json_answer(gather(call.services.store.payloads(), about, extent));
}

}  // namespace raywatch::endpoints
