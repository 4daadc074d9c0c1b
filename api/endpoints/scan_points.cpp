#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/endpoints.hpp"
#include "api/lookup.hpp"
#include "api/point_set.hpp"
#include "api/render.hpp"
#include "storage/formats/write.hpp"
#include "storage/payloads.hpp"

namespace raywatch::endpoints {
namespace {

struct StoredScan {
  ScanRecord record;
  Site site;
};

StoredScan read_scan(Call& call, ScanId id) {
  return call.services.store.read([&](const Snapshot& snapshot) {
    const ScanRecord record = scan_with(snapshot, id);
    return StoredScan{record, site_with(snapshot, record.site)};
  });
}

/// The bytes change only when the pose is refined.
std::string tag_of(const StoredScan& scan, const PointRequest& request) {
  return entity_tag(scan.record.sha256 + format_rfc3339(scan.record.captured_at) +
                    to_json_text(render(local_pose(scan.record, scan.site))) +
                    to_json_text(render(origin_of(scan.site))) + text_of(request));
}

PointSet as_asked(const StoredScan& scan, PointCloud points, const PointRequest& request) {
  PointSet set;
  if (request.frame == Frame::world) {
    append_moved(set, points, local_pose(scan.record, scan.site));
    set.origin_m = origin_of(scan.site);
  } else {
    set.x_m = std::move(points.x_m);
    set.y_m = std::move(points.y_m);
    set.z_m = std::move(points.z_m);
    set.viewpoint = scan.record.pose;
  }
  set.intensity = std::move(points.intensity);
  return set;
}

/// The file that comes back bit-exact when it is uploaded again.
HttpAnswer raw_pcd_answer(PointCloud points, const Pose& pose, const std::string& name) {
  HttpAnswer answer;
  answer.content_type = media_type(PointFormat::pcd);
  answer.stream = [cloud = std::make_shared<const PointCloud>(std::move(points)), pose](std::ostream& out) {
    write_scan_pcd(out, *cloud, pose);
  };
  suggest_file_name(answer, name + ".pcd");
  return answer;
}

}  // namespace

HttpAnswer get_scan_points(Call& call) {
  const PointRequest request = parse_point_request(call.query, Frame::sensor);
  call.query.finish();
  const StoredScan scan = read_scan(call, id_in_path<ScanId>(call.path[0]));
  const std::string tag = tag_of(scan, request);
  if (is_cached(call.header("If-None-Match"), tag)) return not_modified(tag);

  const auto load = [&] { return call.services.store.payloads().scan_points(scan.record.payload); };
  const std::string name = "scan-" + std::to_string(scan.record.id.value);
  const bool raw =
      request.frame == Frame::sensor && request.format == PointFormat::pcd && !request.voxel_m && !request.budget;
  HttpAnswer answer = raw ? raw_pcd_answer(load(), scan.record.pose, name)
                          : point_answer(requested_points(*call.services.ordered_points, tag_of(scan, whole(request)),
                                                          request, [&] { return as_asked(scan, load(), request); }),
                                         request.format, name);
  answer.set_header("ETag", tag);
  return answer;
}

}  // namespace raywatch::endpoints
