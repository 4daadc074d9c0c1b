#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/ordered_points.hpp"
#include "core/time.hpp"
#include "storage/channels.hpp"
#include "storage/comparisons.hpp"
#include "storage/formats/scan_file.hpp"
#include "storage/retention_limits.hpp"
#include "storage/scans.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// A received scan file, complete on the disk.
struct Upload {
  std::filesystem::path file;  ///< spooled body; whoever handles the upload does not delete it
  std::string sha256;          ///< of the body, lower-case hex
  ScanHints hints;             ///< from the query; `sensor` is set
};

struct UploadResult {
  std::vector<ScanRecord> scans;
  bool already_stored = false;  ///< every scan was there before, with the same bytes
};

/// How the test of a channel went.
struct ChannelTest {
  bool delivered = false;
  std::optional<std::int64_t> response_code;
  std::string error;  ///< empty when it was delivered
  double took_ms = 0.0;
};

/// What an operator asks for, carried out by the daemon. Every function is thread-safe and throws `core/error.hpp`.
struct Commands {
  /// Decodes, stores durably, and queues the comparison with the reference `previous`. Overloaded when the queue is
  /// full.
  std::function<UploadResult(const Upload&)> ingest;
  /// Queues a comparison of a stored scan. Overloaded when the queue is full.
  std::function<ComparisonRecord(ScanId, const Reference&, const CompareParameters&)> compare;
  /// Waits until all jobs of a scan ended, or the time is over; true if they ended.
  std::function<bool(ScanId, std::chrono::milliseconds)> wait_for_scan;
  /// 0..1 for a running comparison.
  std::function<double(ComparisonId)> progress;
  /// Deletes a scan and its payloads.
  std::function<void(ScanId)> delete_scan;
  /// Copies the running store into a directory on the daemon's machine.
  std::function<void(const std::filesystem::path&)> backup;
  /// Sends a test message at once.
  std::function<ChannelTest(ChannelId)> test_channel;
  /// Deletes a channel, and resolves the alerts about it.
  std::function<void(ChannelId)> delete_channel;
};

/// Messages to the channels of one kind.
struct DeliveryFigures {
  ChannelKind kind = ChannelKind::webhook;
  std::uint64_t pending = 0;                ///< now
  std::uint64_t delivered = 0, failed = 0;  ///< since the start
};

/// What `/readyz` and `/metrics` report of the daemon.
struct DaemonStatus {
  bool writable = false;
  unsigned workers_alive = 0, workers_expected = 0;
  std::uint64_t queue_length = 0, queue_limit = 0;
  std::uint64_t index_cache_bytes = 0, index_cache_limit_bytes = 0, index_cache_hits = 0, index_cache_misses = 0;
  std::uint64_t scans_ingested = 0, comparisons_finished = 0, comparisons_failed = 0;
  std::uint64_t scans_deleted = 0, bytes_deleted = 0, events_deleted = 0;  ///< by retention
  std::uint64_t folder_files_stored = 0, folder_files_known = 0, folder_files_failed = 0, folder_files_waiting = 0;
  std::uint64_t free_disk_bytes = 0, resident_bytes = 0;
  std::vector<DeliveryFigures> deliveries;
};

/// Everything that the HTTP endpoints are given.
struct Services {
  Store& store;
  Commands commands;
  std::function<DaemonStatus()> status;
  std::function<Time()> now;
  std::function<void(const std::string&)> report = {};  ///< takes note of a request that failed by the daemon's fault
  RetentionLimits retention_defaults = {};              ///< of sites that say nothing else
  std::shared_ptr<OrderedPoints> ordered_points = std::make_shared<OrderedPoints>(std::size_t{384} << 20);
};

}  // namespace raywatch
