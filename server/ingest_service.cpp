#include "server/ingest_service.hpp"

#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/field_errors.hpp"
#include "core/error.hpp"
#include "core/index_scan.hpp"
#include "core/panorama.hpp"
#include "core/profile.hpp"
#include "core/sensor.hpp"
#include "server/unowned_payloads.hpp"
#include "storage/comparisons.hpp"
#include "storage/events.hpp"
#include "storage/formats/side_car.hpp"
#include "storage/payloads.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"

namespace raywatch {
namespace {

/// A scan on its way into the store.
struct ArrivingScan {
  ScanRecord record;
  PointCloud points;
  UsableRange usable;
  std::optional<PriorIndex> index;  ///< of the returns in `usable`; none when many scans arrive together
};

struct SensorAndSite {
  Sensor sensor;
  Site site;
};

SensorAndSite find_sensor_and_site(const Snapshot& snapshot, const std::string& name) {
  std::optional<Sensor> sensor = find_sensor(snapshot, name);
  if (!sensor) throw NotFound("there is no sensor \"" + name + "\"");
  std::optional<Site> site = find_site(snapshot, sensor->site);
  if (!site) throw NotFound("the site of sensor \"" + name + "\" does not exist");
  return {std::move(*sensor), std::move(*site)};
}

/// The pose of what says nothing of its own: the sensor's; of bytes that are stored already, the one that they got
/// then.
std::optional<Pose> fixed_pose_for(const Snapshot& snapshot, const Upload& upload, const Sensor& sensor) {
  if (!upload.hints.captured_at) return sensor.pose;
  const std::optional<ScanRecord> stored = find_scan(snapshot, sensor.id, *upload.hints.captured_at);
  return stored && stored->sha256 == upload.sha256 ? stored->pose : sensor.pose;
}

/// The words suit whoever uploads and whoever puts files into a folder.
void check_complete(const DecodedScan& scan, Time latest_allowed) {
  FieldErrors missing;
  if (!scan.world_from_sensor) {
    missing.add("pose", std::string("nothing says from where the scan was taken (an identity VIEWPOINT counts as "
                                    "absent). Write it into FILE.json beside the file: ") +
                            kPoseInSideCar +
                            ", or give pose=x,y,z,qx,qy,qz,qw with an upload, or a fixed pose to the sensor");
  }
  if (!scan.captured_at) {
    missing.add("captured_at", std::string("nothing says when the scan was taken. Write it into FILE.json beside the "
                                           "file: ") +
                                   kTimeInSideCar + ", or give captured_at=... with an upload");
  }
  missing.throw_if_any();
  if (*scan.captured_at > latest_allowed) {
    const std::string message = format_rfc3339(*scan.captured_at) + " lies in the future";
    throw InvalidInput("The capture time " + message + ".", {{"captured_at", message}});
  }
}

/// Several scans of one file were taken one after the other; a file has one time, and no two scans of a sensor may
/// share theirs.
constexpr Duration kApartInFile = std::chrono::microseconds(1);

ArrivingScan arriving_scan(DecodedScan decoded, const Sensor& sensor, const std::string& sha256,
                           const CompareParameters& parameters) {
  ArrivingScan scan;
  scan.points = std::move(decoded.points);
  ScanIndex indexed = index_scan(scan.points, sensor.known, parameters);
  scan.usable = indexed.usable;
  scan.index = std::move(indexed.index);
  scan.record.site = sensor.site;
  scan.record.sensor = sensor.id;
  scan.record.captured_at = *decoded.captured_at;
  scan.record.points = scan.points.size();
  scan.record.sha256 = sha256;
  scan.record.pose = *decoded.world_from_sensor;
  scan.record.estimated = indexed.estimated;
  scan.record.grid = scan.points.grid;
  scan.record.has_intensity = !scan.points.intensity.empty();
  return scan;
}

/// Points that are nowhere lie together, too.
bool lie_together(const PointCloud& a, const PointCloud& b) {
  constexpr float kSamePlace_m = 0.01f;
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].allFinite() != b[i].allFinite()) return false;
    if (a[i].allFinite() && (a[i] - b[i]).norm() > kSamePlace_m) return false;
  }
  return true;
}

/// The stored scans, when all of them are there with the same bytes.
/// @throws Conflict when one is there with other bytes.
std::optional<std::vector<ScanRecord>> find_stored(const Snapshot& snapshot, const std::vector<ArrivingScan>& scans) {
  std::vector<ScanRecord> stored;
  for (const ArrivingScan& scan : scans) {
    std::optional<ScanRecord> found = find_scan(snapshot, scan.record.sensor, scan.record.captured_at);
    if (!found) continue;
    if (found->sha256 != scan.record.sha256) {
      throw Conflict("scan " + std::to_string(found->id.value) + " is of the same sensor and time (" +
                     format_rfc3339(found->captured_at) + ") and has other bytes");
    }
    stored.push_back(std::move(*found));
  }
  if (stored.size() != scans.size()) return std::nullopt;
  return stored;
}

/// What makes a scan another one than the stored one of the same bytes, if anything does.
std::optional<FieldError> difference(const ArrivingScan& scan, const ScanRecord& stored, const Payloads& payloads) {
  constexpr double kSamePosition_m = 1e-4, kSameAngle_rad = 1e-5;  // poses are rounded when they are written
  const std::string name = "scan " + std::to_string(stored.id.value);
  const double shift_m = (scan.record.pose.position_m - stored.pose.position_m).norm();
  const double turn_rad = angle_between_rad(scan.record.pose, stored.pose);
  if (shift_m > kSamePosition_m || turn_rad > kSameAngle_rad) {
    char text[80];
    std::snprintf(text, sizeof text, "%.4g m and %.4g degrees", shift_m, turn_rad * 180.0 / std::numbers::pi);
    return FieldError{"pose", "differs from that of " + name + " by " + text};
  }
  if (lie_together(scan.points, payloads.scan_points(stored.payload))) return std::nullopt;
  return FieldError{"frame", "is another one than that of " + name + ", or the format is: the points lie elsewhere"};
}

Conflict conflict_with(const ScanRecord& stored, const FieldError& found) {
  const std::string id = std::to_string(stored.id.value);
  return Conflict("scan " + id + " is of the same sensor and time (" + format_rfc3339(stored.captured_at) +
                      ") and has the same bytes; the " + found.field + " " + found.message +
                      ". Nothing was changed: delete scan " + id + " first, or give another capture time",
                  {found});
}

/// @throws Conflict when an arriving scan has the bytes of a stored one, but another pose or frame.
void refuse_other_placement(const std::vector<ArrivingScan>& scans, const std::vector<ScanRecord>& stored,
                            const Payloads& payloads) {
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (const auto found = difference(scans[i], stored[i], payloads)) throw conflict_with(stored[i], *found);
  }
}

/// Stores the records, their comparisons with what was before and with what is normal, and what they show about the
/// sensor.
std::vector<ScanRecord> insert_all(Transaction& transaction, const std::vector<ArrivingScan>& scans,
                                   const CompareParameters& parameters, Time now) {
  std::vector<ScanRecord> stored;
  for (const ArrivingScan& scan : scans) {
    stored.push_back(insert_scan(transaction, scan.record));
    insert_comparison(transaction, stored.back().id, PreviousReference{}, parameters, now);
    insert_comparison(transaction, stored.back().id, BaselineReference{}, parameters, now, Watching::yes);
    insert_event(transaction, {.at = now,
                               .type = "scan.stored",
                               .site = stored.back().site,
                               .scan = stored.back().id,
                               .sensor = stored.back().sensor,
                               .text = "A scan was stored."});
    const std::optional<Sensor> sensor = find_sensor(transaction, scan.record.sensor);
    if (!sensor) throw NotFound("the sensor was deleted");
    set_estimated_model(transaction, sensor->id, merged(sensor->estimated, scan.record.estimated));
  }
  return stored;
}

template <class Semaphore>
class Slot {
 public:
  explicit Slot(Semaphore& semaphore) : semaphore_(semaphore) { semaphore_.acquire(); }
  ~Slot() { semaphore_.release(); }
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;

 private:
  Semaphore& semaphore_;
};

}  // namespace

void refuse_when_full(const Snapshot& snapshot, std::uint64_t limit) {
  constexpr std::chrono::seconds kRetryAfter{1};
  const std::uint64_t unfinished = unfinished_jobs(snapshot);
  if (unfinished < limit) return;
  throw Overloaded(std::to_string(unfinished) + " comparisons are waiting", kRetryAfter);
}

IngestService::IngestService(Store& store, IndexCache& cache, const IngestConfig& config, std::function<Time()> now)
    : store_(store), cache_(cache), config_(config), now_(std::move(now)) {}

UploadResult IngestService::ingest(const Upload& upload) {
  const Slot slot(decoders_);
  const Time now = now_();
  ScanHints hints = upload.hints;
  const SensorAndSite place = store_.read([&](const Snapshot& snapshot) {
    refuse_when_full(snapshot, config_.queue_limit);
    SensorAndSite found = find_sensor_and_site(snapshot, upload.hints.sensor.value_or(""));
    hints.fixed_pose = fixed_pose_for(snapshot, upload, found.sensor);
    return found;
  });
  const CompareParameters defaults = default_parameters(place.site.profile, Grouping::consensus);
  std::vector<DecodedScan> decoded = read_scan_file(upload.file, hints, config_.file_limits);
  std::vector<ArrivingScan> scans;
  for (std::size_t i = 0; i < decoded.size(); ++i) {
    check_complete(decoded[i], now + config_.future_tolerance);
    const std::string part = decoded.size() == 1 ? "" : "#" + std::to_string(i + 1);
    *decoded[i].captured_at += kApartInFile * i;
    scans.push_back(arriving_scan(std::move(decoded[i]), place.sensor, upload.sha256 + part, defaults));
    scans.back().record.received_at = now;
    if (decoded.size() > 1) scans.back().index.reset();
  }
  decoded.clear();

  const auto find_in_store = [&](const Snapshot& snapshot) { return find_stored(snapshot, scans); };
  if (auto stored = store_.read(find_in_store)) {
    refuse_other_placement(scans, *stored, store_.payloads());
    return {std::move(*stored), true};
  }

  UnownedPayloads written(store_.payloads());
  for (ArrivingScan& scan : scans) {
    scan.record.payload = written.add(store_.payloads().put_scan(place.site.id, scan.record.captured_at, scan.points,
                                                                 make_panorama(scan.points, scan.usable)));
    scan.record.stored_bytes = store_.payloads().stored_bytes(scan.record.payload);
  }
  UploadResult result = store_.write([&](Transaction& transaction) -> UploadResult {
    if (auto stored = find_in_store(transaction)) return {std::move(*stored), true};
    refuse_when_full(transaction, config_.queue_limit);
    return {insert_all(transaction, scans, defaults, now), false};
  });
  if (result.already_stored) {
    refuse_other_placement(scans, result.scans, store_.payloads());
    return result;
  }
  written.keep();
  if (scans.front().index) {
    ArrivingScan& scan = scans.front();
    cache_.put({result.scans.front().id, scan.usable}, {std::move(scan.points), std::move(*scan.index)});
  }
  return result;
}

}  // namespace raywatch
