#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/compare.hpp"
#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/payloads.hpp"
#include "storage/registration.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// Which earlier scans stand for the state of the world that a scan is compared with.
struct PreviousReference {
  friend bool operator==(const PreviousReference&, const PreviousReference&) = default;
};
/// What is accepted as normal.
struct BaselineReference {
  friend bool operator==(const BaselineReference&, const BaselineReference&) = default;
};
struct WindowReference {
  Time from, to;  ///< from <= captured_at < to
  friend bool operator==(const WindowReference&, const WindowReference&) = default;
};
struct ExplicitReference {
  std::vector<ScanId> scans;
  friend bool operator==(const ExplicitReference&, const ExplicitReference&) = default;
};
using Reference = std::variant<PreviousReference, BaselineReference, WindowReference, ExplicitReference>;

enum class ComparisonState : std::uint8_t { queued, running, done, failed };
std::string_view to_string(ComparisonState state);

/// One prior as it was used.
struct ComparisonPrior {
  ScanId scan;
  VantageId vantage;
  double overlap = 0.0;
  std::uint64_t added = 0;
  std::uint64_t removed = 0;
};

/// One scan that was considered as a prior, and what became of it.
struct ComparisonCandidate {
  ScanId scan;
  VantageId vantage;
  double distance_m = 0.0;
  Duration age{};
  double overlap = 0.0;
  double gain = 0.0;
  bool chosen = false;
  std::string reason;
};

/// One scan against one reference.
struct ComparisonRecord {
  ComparisonId id;
  ScanId scan;
  SiteId site;
  ComparisonState state = ComparisonState::queued;
  std::string failure;
  Reference reference;
  CompareParameters parameters;
  bool watching = false;  ///< tracks are kept by it: the comparison of an upload with the baseline
  std::vector<ComparisonPrior> priors;
  std::array<std::uint64_t, kPointClasses> counts{};
  double testable = 0.0;
  std::uint64_t changes = 0;
  std::map<std::string, double> timings_ms;
  std::vector<std::string> warnings;
  PayloadRef payload;
  Time created_at;
  std::optional<Time> finished_at;
};

/// A change as stored; places are local.
struct ChangeRecord {
  ChangeId id;
  ComparisonId comparison;
  SiteId site;
  ScanId scan;
  Time captured_at;        ///< of the scan
  std::int32_t place = 0;  ///< in its comparison; what `ComparisonPoints::change_of` refers to
  std::optional<TrackId> track;
  Change change;
};

/// A unit of durable work: run one comparison.
struct Job {
  JobId id;
  ComparisonId comparison;
  ScanId scan;
  SiteId site;
  int attempts = 0;  ///< times that it was started
};

enum class Watching : bool { no, yes };
/// Queues a comparison of a stored scan, with its job.
ComparisonRecord insert_comparison(Transaction& transaction, ScanId scan, const Reference& reference,
                                   const CompareParameters& parameters, Time now, Watching watching = Watching::no);
std::optional<ComparisonRecord> find_comparison(const Snapshot& snapshot, ComparisonId id);

struct ComparisonFilter {
  std::optional<SiteId> site;
  std::optional<ScanId> scan;
  std::optional<ComparisonState> state;
};
/// Newest first.
Page<ComparisonRecord> list_comparisons(const Snapshot& snapshot, const ComparisonFilter& filter,
                                        const PageRequest& page);
/// All of one scan, oldest first.
std::vector<ComparisonRecord> comparisons_of(const Snapshot& snapshot, ScanId scan);
std::vector<ComparisonCandidate> candidates_of(const Snapshot& snapshot, ComparisonId id);

/// Takes the job of `site` that is earliest by the capture time of its scan, then by id, among those that may run
/// beside the ones that are started, and marks it, its comparison and its scan as started. The comparisons that are
/// watched run one after the other, each after the earlier ones of its scan; all others run one after the other beside
/// them.
std::optional<Job> start_job(Transaction& transaction, SiteId site);
/// The sites with jobs that are not started.
std::vector<SiteId> sites_with_jobs(const Snapshot& snapshot);
std::uint64_t unfinished_jobs(const Snapshot& snapshot);
/// After a stop: jobs that were started and not finished become ready again. Returns how many. One that was started
/// more than 5 times is taken for what stops the program: it ends as failed.
std::uint64_t requeue_started_jobs(Transaction& transaction);

/// What a finished comparison adds to the store.
struct ComparisonResult {
  std::vector<ComparisonPrior> priors;
  std::vector<ComparisonCandidate> candidates;
  std::array<std::uint64_t, kPointClasses> counts{};
  double testable = 0.0;
  std::vector<Change> changes;
  std::map<std::string, double> timings_ms;
  std::vector<std::string> warnings;
  PayloadRef payload;
  std::uint64_t stored_bytes = 0;            ///< of the payload
  std::optional<Registration> registration;  ///< of the scan, when this comparison's job refined its pose
};
/// Commits a result, the end of its job and the scan's state, once, and gives the ids of its changes: a job that is
/// already finished changes nothing and gives nothing (its payload is then without an owner).
std::optional<std::vector<ChangeId>> finish_job(Transaction& transaction, const Job& job,
                                                const ComparisonResult& result, Time now);
/// Ends a job without a result. The scan becomes `failed` when this was its only comparison.
void fail_job(Transaction& transaction, const Job& job, std::string_view why, Time now);
/// Puts a started job back (transient trouble such as a full disk); that start does not count as an attempt.
void requeue_job(Transaction& transaction, const Job& job);

struct ChangeFilter {
  std::optional<SiteId> site;
  std::optional<ComparisonId> comparison;
  std::optional<TrackId> track;
  std::optional<ChangeKind> kind;
  std::optional<Time> from, to;
  std::optional<Eigen::AlignedBox3d> box_m;  ///< local; needs `site`; changes whose bounds intersect it (R*Tree)
  std::optional<double> min_volume_m3;
  bool watching = false;  ///< what lasts, by the watching comparisons; else all others. Ignored with
                          ///< `comparison`, all of whose changes are meant
};
/// Newest capture first, then by place in the comparison.
Page<ChangeRecord> list_changes(const Snapshot& snapshot, const ChangeFilter& filter, const PageRequest& page);
std::optional<ChangeRecord> find_change(const Snapshot& snapshot, ChangeId id);
void set_track(Transaction& transaction, ChangeId id, TrackId track);
/// All of a track that one scan showed in its watching comparison, by place.
std::vector<ChangeRecord> changes_of_track(const Snapshot& snapshot, TrackId track, ScanId scan);

}  // namespace raywatch
