#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/compare.hpp"
#include "core/ids.hpp"
#include "core/panorama.hpp"
#include "core/point_cloud.hpp"
#include "core/time.hpp"
#include "storage/chunk_codec.hpp"

namespace raywatch {

/// Where a payload lies: the file of its site and month, and its key there. `{"", 0}` is nowhere.
struct PayloadRef {
  std::string file;  ///< relative to the data directory, such as "payload/3/2026-11.db"
  std::int64_t key = 0;
  friend bool operator==(const PayloadRef&, const PayloadRef&) = default;
};

/// The per-point part of a comparison's result.
struct ComparisonPoints {
  std::vector<PointClass> classes;
  std::vector<std::uint8_t> free;
  std::vector<std::uint8_t> supported;
  std::vector<std::int32_t> change_of;
  std::vector<PriorPoint> prior_points;
};

/// What the payload files of a site hold.
struct PayloadUse {
  std::uint64_t in_use_bytes = 0;
  std::uint64_t freed_bytes = 0;  ///< not given back to the disk yet
};

/// Points and point classes in one SQLite file per site and month.
///
/// Scan points are kept bit-exact and in their order: planes, byte-shuffled and compressed with zstd, in chunks
/// of at most `kChunkPoints` with a checksum and their bounds in direction and range. Thread-safe. When a `put_`
/// returns, the payload is on the disk; one without a reference from the metadata is swept at the next start.
class Payloads {
 public:
  struct Impl;
  explicit Payloads(std::unique_ptr<Impl> impl);
  ~Payloads();

  PayloadRef put_scan(SiteId site, Time captured_at, const PointCloud& points, const Panorama& panorama);
  /// @throws CorruptData when a checksum does not match; NotFound when there is no such payload.
  PointCloud scan_points(const PayloadRef& ref) const;
  /// Points, among which are all that lie in the cone, by chunk; reads only the chunks whose bounds meet it.
  std::vector<PointCloud> scan_points_around(const PayloadRef& ref, const DirectionCone& cone) const;
  Panorama scan_panorama(const PayloadRef& ref) const;
  std::uint64_t stored_bytes(const PayloadRef& ref) const;
  PayloadUse use_of(SiteId site) const;
  /// Deletions wait while the store is copied: what is asked for now is gone only then.
  bool deletions_wait() const;

  PayloadRef put_comparison(SiteId site, Time captured_at, const ComparisonPoints& points);
  ComparisonPoints comparison_points(const PayloadRef& ref) const;

  /// Deletes; a payload that is not there is no error.
  void remove(const PayloadRef& ref);

  Impl& impl();

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace raywatch
