#include "server/daemon.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <list>
#include <thread>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "server/caretaker.hpp"
#include "server/comparison_runner.hpp"
#include "server/delivery/deliverer.hpp"
#include "server/folder_intake.hpp"
#include "server/index_cache.hpp"
#include "server/ingest_service.hpp"
#include "server/machine.hpp"
#include "server/progress_board.hpp"
#include "server/reference_resolver.hpp"
#include "server/survey_thread.hpp"
#include "server/version.hpp"
#include "server/workers.hpp"
#include "storage/baselines.hpp"
#include "storage/comparisons.hpp"
#include "storage/deletions.hpp"
#include "storage/payloads.hpp"
#include "storage/signal.hpp"
#include "storage/sites.hpp"
#include "storage/sweep.hpp"

namespace raywatch {
namespace {

/// How long running comparisons are waited for at a stop.
constexpr std::chrono::seconds kStopPatience{3};

unsigned cores() { return std::max(1u, std::thread::hardware_concurrency()); }

HttpConfig http_config(const DaemonConfig& config) {
  HttpConfig http = config.http;
  if (http.spool_dir.empty()) http.spool_dir = config.data_dir / "spool";
  http.public_url = config.delivery.public_url;
  return http;
}

bool all_ended(const std::vector<ComparisonRecord>& comparisons) {
  return std::ranges::all_of(comparisons, [](const ComparisonRecord& comparison) {
    return comparison.state == ComparisonState::done || comparison.state == ComparisonState::failed;
  });
}

/// Puts back what an earlier process started and did not end.
std::uint64_t recover(Store& store, Time now) {
  return store.write([&](Transaction& transaction) {
    return requeue_started_jobs(transaction) + requeue_running_runs(transaction, now);
  });
}

}  // namespace

/// The members are in the order of their start; they stop in the reverse one.
struct Daemon::Impl {
  Impl(const DaemonConfig& given, std::function<Time()> clock)
      : config(given),
        now(std::move(clock)),
        store({.data_dir = config.data_dir, .min_free_bytes = config.min_free_disk_bytes}),
        cache(config.index_cache_bytes),
        ingest(store, cache,
               {.queue_limit = config.queue_limit, .future_tolerance = config.future_tolerance, .file_limits = {}},
               now),
        runner(store, cache, progress,
               {.previous_limit = config.previous_limit, .choice = config.choice, .watch = config.watch}, now),
        requeued(recover(store, now())),
        workers(store, runner, signal,
                {.workers = config.workers > 0 ? config.workers : cores(),
                 .compare_threads = config.compare_threads > 0 ? std::min(config.compare_threads, cores()) : cores()},
                now),
        schedule_clock(store),
        survey_runner(store, cache, program_version(), now),
        surveys(schedule_clock, survey_runner,
                config.compare_threads > 0 ? std::min(config.compare_threads, cores()) : cores(), now),
        caretaker(store, {.low_disk_bytes = 2 * config.min_free_disk_bytes}),
        retention(store, config.retention, [this](ScanId scan) { cache.forget(scan); }),
        caretaker_thread(caretaker, retention, now),
        deliverer(store, config.delivery, now),
        http(http_config(config),
             {store, commands(), [this] { return status(); }, now,
              [](const std::string& failure) { spdlog::error("{}", failure); }, config.retention.defaults}) {
    for (const FolderConfig& folder : config.folders) {
      folders.emplace_back(std::make_unique<FolderIntake>(
          store, folder, [this](const Upload& upload) { return ingest_file(upload); }, now, folder_status));
    }
    for (const std::string& warning : store.open_report().warnings) spdlog::warn("the store: {}", warning);
    if (requeued > 0) spdlog::info("{} comparisons and surveys were interrupted and start again", requeued);
    http.start();
  }

  Commands commands();
  UploadResult ingest_file(const Upload& upload);
  UploadResult receive(const Upload& upload);
  ComparisonRecord compare_again(ScanId scan, const Reference& reference, const CompareParameters& parameters);
  bool wait_for_scan(ScanId scan, std::chrono::milliseconds patience);
  void delete_scan(ScanId scan);
  DaemonStatus status() const;
  StopOutcome stop();

  const DaemonConfig config;
  const std::function<Time()> now;
  Store store;
  IndexCache cache;
  ProgressBoard progress;
  Signal signal;
  IngestService ingest;
  std::atomic<std::uint64_t> scans_ingested{0};
  ComparisonRunner runner;
  const std::uint64_t requeued;
  Workers workers;
  ScheduleClock schedule_clock;
  SurveyRunner survey_runner;
  SurveyThread surveys;
  Caretaker caretaker;
  RetentionKeeper retention;
  CaretakerThread caretaker_thread;
  Deliverer deliverer;
  FolderStatus folder_status;
  HttpServer http;
  std::list<FolderThread> folders;
};

Commands Daemon::Impl::commands() {
  return {.ingest = [this](const Upload& upload) { return receive(upload); },
          .compare = [this](ScanId scan, const Reference& reference,
                            const CompareParameters& parameters) { return compare_again(scan, reference, parameters); },
          .wait_for_scan = [this](ScanId scan,
                                  std::chrono::milliseconds patience) { return wait_for_scan(scan, patience); },
          .progress = [this](ComparisonId id) { return progress.of(id); },
          .delete_scan = [this](ScanId scan) { delete_scan(scan); },
          .backup = [this](const std::filesystem::path& directory) { store.backup(directory); },
          .test_channel = [this](ChannelId channel) { return deliverer.test(channel); },
          .delete_channel = [this](ChannelId channel) { deliverer.delete_channel(channel); }};
}

UploadResult Daemon::Impl::ingest_file(const Upload& upload) {
  UploadResult result = ingest.ingest(upload);
  if (result.already_stored) return result;
  scans_ingested += result.scans.size();
  signal.notify();
  return result;
}

/// What is uploaded; of files in folders their thread says more.
UploadResult Daemon::Impl::receive(const Upload& upload) {
  UploadResult result = ingest_file(upload);
  if (result.already_stored) return result;
  for (const ScanRecord& scan : result.scans) {
    spdlog::info("scan {} of sensor {} stored: {} points, captured at {}", scan.id.value, *upload.hints.sensor,
                 scan.points, format_rfc3339(scan.captured_at));
  }
  return result;
}

ComparisonRecord Daemon::Impl::compare_again(ScanId scan, const Reference& reference,
                                             const CompareParameters& parameters) {
  ComparisonRecord queued = store.write([&](Transaction& transaction) {
    refuse_when_full(transaction, config.queue_limit);
    const std::optional<ScanRecord> record = find_scan(transaction, scan);
    if (!record) throw NotFound("scan " + std::to_string(scan.value) + " does not exist");
    // Scans that are named must be there and usable; the others are looked for when the job runs.
    if (is_explicit(reference)) {
      resolve_reference(transaction, *record, *find_site(transaction, record->site), reference, {});
    }
    return insert_comparison(transaction, scan, reference, parameters, now());
  });
  signal.notify();
  return queued;
}

bool Daemon::Impl::wait_for_scan(ScanId scan, std::chrono::milliseconds patience) {
  const auto deadline = Signal::Clock::now() + patience;
  for (;;) {
    const std::uint64_t seen = signal.generation();
    if (store.read([&](const Snapshot& snapshot) { return all_ended(comparisons_of(snapshot, scan)); })) return true;
    if (!signal.wait_past(seen, deadline)) return false;
  }
}

void Daemon::Impl::delete_scan(ScanId scan) {
  const std::vector<PayloadRef> payloads = store.write([&](Transaction& transaction) {
    const std::optional<ScanRecord> record = find_scan(transaction, scan);
    const std::uint64_t bytes = bytes_of_scan(transaction, scan);
    withdraw_from_baseline(transaction, scan, now());
    std::vector<PayloadRef> freed = raywatch::delete_scan(transaction, scan);
    record_deleted_scan(transaction, *record, bytes, DeletionReason::by_operator, now());
    return freed;
  });
  for (const PayloadRef& payload : payloads) store.payloads().remove(payload);
  cache.forget(scan);
}

DaemonStatus Daemon::Impl::status() const {
  const WorkersStatus working = workers.status();
  const IndexCacheStatus cached = cache.status();
  const RetentionStatus kept = retention.status();
  const std::uint64_t free_bytes = free_disk_bytes(config.data_dir);
  return {.writable = free_bytes >= config.min_free_disk_bytes && is_writable(config.data_dir),
          .workers_alive = working.alive,
          .workers_expected = working.expected,
          .queue_length = store.read([](const Snapshot& snapshot) { return unfinished_jobs(snapshot); }),
          .queue_limit = config.queue_limit,
          .index_cache_bytes = cached.bytes,
          .index_cache_limit_bytes = config.index_cache_bytes,
          .index_cache_hits = cached.hits,
          .index_cache_misses = cached.misses,
          .scans_ingested = scans_ingested,
          .comparisons_finished = working.finished,
          .comparisons_failed = working.failed,
          .scans_deleted = kept.scans_deleted,
          .bytes_deleted = kept.bytes_deleted,
          .events_deleted = kept.events_deleted,
          .folder_files_stored = folder_status.stored,
          .folder_files_known = folder_status.known,
          .folder_files_failed = folder_status.failed,
          .folder_files_waiting = folder_status.waiting,
          .free_disk_bytes = free_bytes,
          .resident_bytes = resident_memory_bytes(),
          .deliveries = deliverer.figures()};
}

StopOutcome Daemon::Impl::stop() {
  const auto deadline = std::chrono::steady_clock::now() + kStopPatience;
  workers.request_stop();
  surveys.request_stop();
  deliverer.request_stop();
  signal.close();
  store.commits().close();  // the streams of events end
  folders.clear();
  http.stop();
  const bool compared = workers.wait_stopped(deadline), surveyed = surveys.wait_stopped(deadline);
  if (!surveyed) store.write([](Transaction& transaction) { put_back_running_runs(transaction); });
  if (!compared || !surveyed) return StopOutcome::comparisons_abandoned;
  return deliverer.wait_stopped(deadline) ? StopOutcome::clean : StopOutcome::deliveries_abandoned;
}

Daemon::Daemon(const DaemonConfig& config, std::function<Time()> now)
    : impl_(std::make_unique<Impl>(config, now ? std::move(now) : std::chrono::system_clock::now)) {}

Daemon::~Daemon() { stop(); }

std::uint16_t Daemon::port() const { return impl_->http.port(); }

StopOutcome Daemon::stop() { return impl_->stop(); }

}  // namespace raywatch
