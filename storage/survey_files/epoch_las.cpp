#include "storage/survey_files/epoch_las.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "storage/formats/out_buffer.hpp"

namespace raywatch {
namespace {

constexpr double kScale_m = 0.001;
constexpr std::uint16_t kLasHeader_bytes = 375, kRecord_bytes = 30;
constexpr std::size_t kVlrHeader_bytes = 54, kLookup_bytes = 256 * 16;
/// Global encoding: adjusted standard GPS time; coordinates described by WKT, as point format 6 demands.
constexpr std::uint16_t kEncoding = 0x01 | 0x10;

/// Calls `visit(scan, point, place in the output's coordinates, class)` for what is written.
template <class Visit>
void for_each_point(const EpochLas& epoch, Visit visit) {
  for (std::size_t k = 0; k < epoch.scans.scans.size(); ++k) {
    const ScanView& scan = epoch.scans.scans[k];
    const Eigen::Matrix3d rotation = scan.world_from_sensor.orientation.toRotationMatrix();
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const PointClass point_class = epoch.about[k].classes[i];
      if (point_class == PointClass::invalid) continue;
      const Eigen::Vector3d in_sensor_m = scan.points[i].cast<double>();
      if (!in_sensor_m.allFinite()) continue;
      visit(k, i, epoch.frame.output_from_local(rotation * in_sensor_m + scan.world_from_sensor.position_m),
            point_class);
    }
  }
}

/// What the header says of all points.
struct Summary {
  std::uint64_t points = 0;
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  ///< whole kilometres near the first point
  Eigen::AlignedBox3d bounds_m;

  explicit Summary(const EpochLas& epoch) {
    for_each_point(epoch, [&](std::size_t, std::size_t, const Eigen::Vector3d& place_m, PointClass) {
      if (points++ == 0) offset_m = (place_m.array() / 1000.0).floor().matrix() * 1000.0;
      bounds_m.extend(place_m);
    });
    if (points == 0) bounds_m = Eigen::AlignedBox3d(Eigen::Vector3d::Zero());
    const double far_m =
        std::max((bounds_m.max() - offset_m).cwiseAbs().maxCoeff(), (bounds_m.min() - offset_m).cwiseAbs().maxCoeff());
    if (far_m > kScale_m * 2.1e9) throw InvalidInput("The points of the epoch lie too far apart for a LAS file.");
  }
  std::int32_t step(double place_m, Eigen::Index axis) const {
    return static_cast<std::int32_t>(std::llround((place_m - offset_m[axis]) / kScale_m));
  }
};

void fixed_text(OutBuffer& out, std::string_view text, std::size_t size) {
  text = text.substr(0, size);
  out.text(text);
  for (std::size_t i = text.size(); i < size; ++i) out.character('\0');
}

template <class T>
void repeat(OutBuffer& out, T value, std::size_t times) {
  for (std::size_t i = 0; i < times; ++i) out.bits(value);
}

std::uint32_t points_offset(const EpochLas& epoch) {
  std::size_t bytes = kLasHeader_bytes + kVlrHeader_bytes + kLookup_bytes;
  if (!epoch.wkt.empty()) bytes += kVlrHeader_bytes + epoch.wkt.size() + 1;
  return static_cast<std::uint32_t>(bytes);
}

void write_header(OutBuffer& out, const EpochLas& epoch, const Summary& summary) {
  out.text("LASF");
  out.bits<std::uint16_t>(0);  // file source
  out.bits(kEncoding);
  repeat<std::uint8_t>(out, 0, 16);  // project id
  out.bits<std::uint8_t>(1);
  out.bits<std::uint8_t>(4);
  fixed_text(out, "raywatch", 32);
  fixed_text(out, "raywatch " + epoch.program_version, 32);
  repeat<std::uint16_t>(out, 0, 2);  // day and year of creation: not known, so that equal surveys give equal bytes
  out.bits(kLasHeader_bytes);
  out.bits(points_offset(epoch));
  out.bits<std::uint32_t>(epoch.wkt.empty() ? 1 : 2);
  out.bits<std::uint8_t>(6);
  out.bits(kRecord_bytes);
  repeat<std::uint32_t>(out, 0, 6);  // the older counts: not with point format 6
  repeat(out, kScale_m, 3);
  for (Eigen::Index axis = 0; axis < 3; ++axis) out.bits(summary.offset_m[axis]);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    out.bits(summary.bounds_m.max()[axis]);
    out.bits(summary.bounds_m.min()[axis]);
  }
  repeat<std::uint64_t>(out, 0, 2);  // waveforms; extended records
  out.bits<std::uint32_t>(0);
  out.bits(summary.points);
  out.bits(summary.points);  // all are first returns
  repeat<std::uint64_t>(out, 0, 14);
}

void write_record_header(OutBuffer& out, std::string_view user, std::uint16_t record, std::size_t bytes,
                         std::string_view description) {
  out.bits<std::uint16_t>(0);
  fixed_text(out, user, 16);
  out.bits(record);
  out.bits(static_cast<std::uint16_t>(bytes));
  fixed_text(out, description, 32);
}

void write_lookup(OutBuffer& out) {
  write_record_header(out, "LASF_Spec", 0, kLookup_bytes, "Classes of change");
  for (std::size_t i = 0; i < 256; ++i) {
    const bool ours = i >= kFirstLasClass && i < kFirstLasClass + kPointClasses;
    out.bits(static_cast<std::uint8_t>(i));
    fixed_text(out, ours ? to_string(static_cast<PointClass>(i - kFirstLasClass)) : std::string_view(), 15);
  }
}

/// Seconds since the GPS epoch, with its leap seconds, minus 10^9.
double adjusted_gps_s(Time time) {
  constexpr double kGpsEpoch_s = 315964800.0, kLeap_s = 18.0, kAdjustment_s = 1e9;
  return std::chrono::duration<double>(time.time_since_epoch()).count() - kGpsEpoch_s + kLeap_s - kAdjustment_s;
}

}  // namespace

void write_las(std::ostream& stream, const EpochLas& epoch) {
  const Summary summary(epoch);
  OutBuffer out(stream);
  write_header(out, epoch, summary);
  write_lookup(out);
  if (!epoch.wkt.empty()) {
    write_record_header(out, "LASF_Projection", 2112, epoch.wkt.size() + 1, "OGC coordinate system WKT");
    fixed_text(out, epoch.wkt, epoch.wkt.size() + 1);
  }
  for_each_point(epoch, [&](std::size_t k, std::size_t i, const Eigen::Vector3d& place_m, PointClass point_class) {
    const ScanView& scan = epoch.scans.scans[k];
    for (Eigen::Index axis = 0; axis < 3; ++axis) out.bits(summary.step(place_m[axis], axis));
    const float intensity = scan.points.intensity.empty() ? 0.0f : scan.points.intensity[i];
    out.bits(static_cast<std::uint16_t>(std::clamp(std::isfinite(intensity) ? intensity : 0.0f, 0.0f, 65535.0f)));
    out.bits<std::uint8_t>(0x11);  // the first of one return
    out.bits<std::uint8_t>(0);     // flags
    out.bits(static_cast<std::uint8_t>(kFirstLasClass + static_cast<std::uint8_t>(point_class)));
    out.bits<std::uint8_t>(0);  // user data
    out.bits<std::int16_t>(0);  // scan angle
    out.bits(static_cast<std::uint16_t>(std::min<std::size_t>(k + 1, 65535)));
    out.bits(adjusted_gps_s(scan.captured_at));
  });
  out.flush();
}

}  // namespace raywatch
