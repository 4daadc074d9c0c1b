#include <algorithm>
#include <bitset>
#include <map>
#include <optional>

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/point_set.hpp"
#include "api/render.hpp"
#include "storage/payloads.hpp"

namespace raywatch::endpoints {
namespace {

using Classes = std::bitset<kPointClasses>;

struct StoredComparison {
  ComparisonRecord record;
  ScanRecord scan;
  std::vector<std::optional<ScanRecord>> priors;  ///< nothing for one that was deleted
  Site site;
};

StoredComparison read_comparison(Call& call, ComparisonId id) {
  return call.services.store.read([&](const Snapshot& snapshot) {
    StoredComparison stored;
    stored.record = comparison_with(snapshot, id);
    if (stored.record.state != ComparisonState::done) {
      throw Conflict("Comparison " + std::to_string(id.value) + " is " + std::string(to_string(stored.record.state)) +
                     "; its points are there when it is done.");
    }
    stored.scan = scan_with(snapshot, stored.record.scan);
    stored.site = site_with(snapshot, stored.record.site);
    for (const ComparisonPrior& prior : stored.record.priors) {
      stored.priors.push_back(find_scan(snapshot, prior.scan));
    }
    return stored;
  });
}

Classes parse_classes(Query& query) {
  Classes classes;
  const auto names = query.list("class");
  if (!names) return classes.set();
  for (const std::string& name : *names) {
    try {
      classes.set(static_cast<std::size_t>(parse_point_class(name)));
    } catch (const InvalidInput& error) {
      query.fail("class", error.what());
    }
  }
  return classes;
}

/// What the points of one scan of the comparison are moved by. Local, or relative to the compared scan's sensor.
Pose output_from(const StoredComparison& stored, const ScanRecord& scan, Frame frame) {
  Pose local_from_scan = local_pose(scan, stored.site);
  if (frame == Frame::world) return local_from_scan;
  if (scan.id == stored.scan.id) return {};
  return local_pose(stored.scan, stored.site).inverse() * local_from_scan;
}

void check_lengths(const ComparisonPoints& result, const PointCloud& points) {
  const std::size_t n = points.size();
  if (result.classes.size() != n || result.free.size() != n || result.supported.size() != n ||
      result.change_of.size() != n) {
    throw CorruptData("The stored classes are not those of the scan's points.");
  }
}

void append_scan_points(PointSet& set, const PointCloud& points, const ComparisonPoints& result,
                        const Pose& output_from_scan, const Classes& wanted) {
  check_lengths(result, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!wanted[static_cast<std::size_t>(result.classes[i])]) continue;
    set.push_back(moved(points[i], output_from_scan));
    set.point_class.push_back(static_cast<std::uint8_t>(result.classes[i]));
    set.free.push_back(result.free[i]);
    set.supported.push_back(result.supported[i]);
    set.change.push_back(result.change_of[i]);
    set.prior.push_back(-1);
  }
}

/// The points of priors that changed. Each is free in one scan, the compared one.
void append_prior_points(PointSet& set, const PointCloud& points, std::span<const PriorPoint> changed,
                         const Pose& output_from_prior, const Classes& wanted) {
  for (const PriorPoint& point : changed) {
    if (!wanted[static_cast<std::size_t>(point.point_class)]) continue;
    if (point.index >= points.size()) throw CorruptData("A stored change names a point that its prior does not have.");
    set.push_back(moved(points[point.index], output_from_prior));
    set.point_class.push_back(static_cast<std::uint8_t>(point.point_class));
    set.free.push_back(1);
    set.supported.push_back(0);
    set.change.push_back(point.change);
    set.prior.push_back(static_cast<std::int32_t>(point.prior));
  }
}

/// Points are left out by request only.
[[noreturn]] void refuse_without(const ComparisonRecord& comparison, std::uint32_t prior) {
  throw NotFound("Scan " + std::to_string(comparison.priors[prior].scan.value) +
                 ", a prior of this comparison, was deleted, and with it the points that were removed. Those of the "
                 "compared scan are there: ask for class=unchanged,added,discrepancy,occluded,unseen,invalid.");
}

PointSet gather(Call& call, const StoredComparison& stored, const PointRequest& request, const Classes& wanted) {
  Payloads& payloads = call.services.store.payloads();
  const ComparisonPoints result = payloads.comparison_points(stored.record.payload);
  PointSet set;
  append_scan_points(set, payloads.scan_points(stored.scan.payload), result,
                     output_from(stored, stored.scan, request.frame), wanted);
  std::map<std::uint32_t, std::vector<PriorPoint>> by_prior;
  for (const PriorPoint& point : result.prior_points) by_prior[point.prior].push_back(point);
  for (const auto& [prior, changed] : by_prior) {
    if (prior >= stored.priors.size()) throw CorruptData("A stored change names a prior that the comparison lacks.");
    const bool is_wanted = std::ranges::any_of(
        changed, [&](const PriorPoint& point) { return wanted[static_cast<std::size_t>(point.point_class)]; });
    if (!is_wanted) continue;
    if (!stored.priors[prior]) refuse_without(stored.record, prior);
    const ScanRecord& scan = *stored.priors[prior];
    append_prior_points(set, payloads.scan_points(scan.payload), changed, output_from(stored, scan, request.frame),
                        wanted);
  }
  if (request.frame == Frame::world) set.origin_m = origin_of(stored.site);
  if (request.frame == Frame::sensor) set.viewpoint = stored.scan.pose;
  return set;
}

std::string tag_of(const StoredComparison& stored, const PointRequest& request, const Classes& wanted) {
  std::string content = stored.scan.sha256 + format_rfc3339(stored.record.created_at) +
                        std::to_string(stored.record.id.value) + to_json_text(render(origin_of(stored.site))) +
                        to_json_text(render(local_pose(stored.scan, stored.site)));
  for (const std::optional<ScanRecord>& prior : stored.priors) {
    content += prior ? to_json_text(render(local_pose(*prior, stored.site))) : "deleted";
  }
  return entity_tag(content + text_of(request) + wanted.to_string());
}

}  // namespace

HttpAnswer get_comparison_points(Call& call) {
  const PointRequest request = parse_point_request(call.query, Frame::world);
  const Classes wanted = parse_classes(call.query);
  call.query.finish();
  const StoredComparison stored = read_comparison(call, id_in_path<ComparisonId>(call.path[0]));
  const std::string tag = tag_of(stored, request, wanted);
  if (is_cached(call.header("If-None-Match"), tag)) return not_modified(tag);

  HttpAnswer answer =
      point_answer(requested_points(*call.services.ordered_points, tag_of(stored, whole(request), wanted), request,
                                    [&] { return gather(call, stored, request, wanted); }),
                   request.format, "comparison-" + std::to_string(stored.record.id.value));
  answer.set_header("ETag", tag);
  return answer;
}

}  // namespace raywatch::endpoints
