#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <semaphore>

#include "api/services.hpp"
#include "core/time.hpp"
#include "server/index_cache.hpp"
#include "storage/formats/scan_file.hpp"
#include "storage/store.hpp"

namespace raywatch {

struct IngestConfig {
  std::uint64_t queue_limit = 1000;           ///< unfinished jobs above which nothing more is accepted
  std::chrono::seconds future_tolerance{60};  ///< a capture time later than now by more than this is refused
  ScanFileLimits file_limits;
};

/// @throws Overloaded when `limit` jobs or more are unfinished.
void refuse_when_full(const Snapshot& snapshot, std::uint64_t limit);

/// Turns received files into stored scans with queued comparisons. Thread-safe.
class IngestService {
 public:
  /// Files that are decoded at once; each is in memory as a whole.
  static constexpr std::ptrdiff_t kDecoders = 4;

  /// What a file of one scan holds is put into `cache`, as its comparisons follow at once.
  IngestService(Store& store, IndexCache& cache, const IngestConfig& config, std::function<Time()> now);

  /// When it returns, every scan of the file is on the disk, and so is the job to compare it with what was before.
  /// @throws NotFound for the sensor; InvalidInput, UnsupportedFormat, TooLarge for the file; Conflict when the sensor
  ///   has another scan of that time, or the same bytes with another pose or frame; Overloaded; DiskFull. Nothing is
  ///   stored then.
  UploadResult ingest(const Upload& upload);

 private:
  Store& store_;
  IndexCache& cache_;
  IngestConfig config_;
  std::function<Time()> now_;
  std::counting_semaphore<kDecoders> decoders_{kDecoders};
};

}  // namespace raywatch
