#include "storage/comparisons.hpp"

#include <functional>
#include <limits>
#include <set>

#include "storage/columns.hpp"
#include "storage/comparison_rows.hpp"
#include "storage/cursor.hpp"
#include "storage/scans.hpp"
#include "storage/snapshot.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kComparisonList = "comparisons";
const std::string kSelectComparisons =
    "SELECT id, scan, site, state, failure, reference, parameters, watching, counts, testable, changes, timings_ms, "
    "warnings, "
    "payload_file, payload_key, created_at, finished_at FROM comparisons ";

std::vector<ComparisonPrior> priors_of(const Snapshot& snapshot, ComparisonId id) {
  Statement rows(
      database_of(snapshot),
      "SELECT scan, vantage, overlap, added, removed FROM comparison_priors WHERE comparison = ? ORDER BY place");
  rows.bind(id);
  std::vector<ComparisonPrior> priors;
  while (rows.next()) {
    ComparisonPrior& prior = priors.emplace_back();
    prior.scan = rows.take<ScanId>();
    prior.vantage = rows.take<VantageId>();
    prior.overlap = rows.take<double>();
    prior.added = rows.take<std::uint64_t>();
    prior.removed = rows.take<std::uint64_t>();
  }
  return priors;
}

ComparisonRecord read_comparison(const Snapshot& snapshot, Statement& row) {
  ComparisonRecord comparison;
  comparison.id = row.take<ComparisonId>();
  comparison.scan = row.take<ScanId>();
  comparison.site = row.take<SiteId>();
  comparison.state = enum_from_text(row.take<std::string>(), {ComparisonState::queued, ComparisonState::running,
                                                              ComparisonState::done, ComparisonState::failed});
  comparison.failure = row.take<std::string>();
  comparison.reference = reference_from_json(row.take<std::string>());
  comparison.parameters = parameters_from_json(row.take<std::string>());
  comparison.watching = row.take<bool>();
  comparison.counts = counts_from_json(row.take<std::string>());
  comparison.testable = row.take<double>();
  comparison.changes = row.take<std::uint64_t>();
  comparison.timings_ms = timings_from_json(row.take<std::string>());
  comparison.warnings = texts_from_json(row.take<std::string>());
  comparison.payload.file = row.take<std::string>();
  comparison.payload.key = row.take<std::int64_t>();
  comparison.created_at = row.take<Time>();
  comparison.finished_at = row.take<std::optional<Time>>();
  comparison.priors = priors_of(snapshot, comparison.id);
  return comparison;
}

/// The index that serves a filter, with what it fixes.
std::string where(const ComparisonFilter& filter) {
  std::string index;
  if (filter.scan) {
    index = "INDEXED BY comparisons_by_scan ";
  } else if (filter.site) {
    index = filter.state ? "INDEXED BY comparisons_by_site_and_state " : "INDEXED BY comparisons_by_site ";
  } else if (filter.state) {
    index = "INDEXED BY comparisons_by_state ";
  }
  return index + "WHERE " + (filter.scan ? "scan = ? AND " : "") + (filter.site ? "site = ? AND " : "") +
         (filter.state ? "state = ? AND " : "");
}

}  // namespace

std::string_view to_string(ComparisonState state) {
  switch (state) {
    case ComparisonState::queued:
      return "queued";
    case ComparisonState::running:
      return "running";
    case ComparisonState::done:
      return "done";
    case ComparisonState::failed:
      break;
  }
  return "failed";
}

void set_comparison_state(Transaction& transaction, ComparisonId id, ComparisonState state, std::string_view failure) {
  database_of(transaction)
      .run("UPDATE comparisons SET state = ?, failure = ? WHERE id = ?", to_string(state), failure, id);
}

void update_scan_state(Transaction& transaction, ScanId scan) {
  Statement rows(database_of(transaction),
                 "SELECT state, failure, watching FROM comparisons INDEXED BY comparisons_by_scan WHERE scan = ? "
                 "ORDER BY id");
  rows.bind(scan);
  std::set<std::string, std::less<>> states;
  std::string last_failure;
  bool watching_waits = false;
  while (rows.next()) {
    std::string state = rows.take<std::string>();
    if (std::string why = rows.take<std::string>(); !why.empty()) last_failure = std::move(why);
    watching_waits = watching_waits || (rows.take<bool>() && state == to_string(ComparisonState::queued));
    states.insert(std::move(state));
  }
  const bool half_done = watching_waits && states.size() > 1;
  if (states.contains(to_string(ComparisonState::running)) || half_done)
    return set_scan_state(transaction, scan, ScanState::comparing);
  if (states.contains(to_string(ComparisonState::done))) return set_scan_state(transaction, scan, ScanState::compared);
  if (states.contains(to_string(ComparisonState::queued))) return set_scan_state(transaction, scan, ScanState::queued);
  set_scan_state(transaction, scan, ScanState::failed, last_failure);
}

ComparisonRecord insert_comparison(Transaction& transaction, ScanId scan, const Reference& reference,
                                   const CompareParameters& parameters, Time now, Watching watching) {
  transaction.impl().require_room_for_records();
  const std::optional<ScanRecord> record = find_scan(transaction, scan);
  if (!record) throw NotFound("there is no scan " + std::to_string(scan.value));
  Database& database = database_of(transaction);
  database.run(
      "INSERT INTO comparisons (scan, site, state, reference, parameters, watching, created_at) "
      "VALUES (?, ?, ?, ?, ?, ?, ?)",
      scan, record->site, to_string(ComparisonState::queued), reference_json(reference), parameters_json(parameters),
      watching == Watching::yes, now);
  const ComparisonId id{database.last_id()};
  database.run("INSERT INTO jobs (comparison, scan, site, captured_at, started, attempts) VALUES (?, ?, ?, ?, 0, 0)",
               id, scan, record->site, record->captured_at);
  update_scan_state(transaction, scan);
  return find_comparison(transaction, id).value();
}

std::optional<ComparisonRecord> find_comparison(const Snapshot& snapshot, ComparisonId id) {
  Statement row(database_of(snapshot), kSelectComparisons + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_comparison(snapshot, row);
}

Page<ComparisonRecord> list_comparisons(const Snapshot& snapshot, const ComparisonFilter& filter,
                                        const PageRequest& page) {
  const auto [before] = key_before<1>(page, kComparisonList, {std::numeric_limits<std::int64_t>::max()});
  Statement rows(database_of(snapshot), kSelectComparisons + where(filter) + "id < ? ORDER BY id DESC LIMIT ?");
  if (filter.scan) rows.bind(*filter.scan);
  if (filter.site) rows.bind(*filter.site);
  if (filter.state) rows.bind(to_string(*filter.state));
  rows.bind(before, rows_to_read(page));
  std::vector<ComparisonRecord> comparisons;
  while (rows.next()) comparisons.push_back(read_comparison(snapshot, rows));
  return make_page(std::move(comparisons), page, kComparisonList,
                   [](const ComparisonRecord& comparison) { return std::array{comparison.id.value}; });
}

std::vector<ComparisonRecord> comparisons_of(const Snapshot& snapshot, ScanId scan) {
  Statement rows(database_of(snapshot),
                 kSelectComparisons + "INDEXED BY comparisons_by_scan WHERE scan = ? ORDER BY id");
  rows.bind(scan);
  std::vector<ComparisonRecord> comparisons;
  while (rows.next()) comparisons.push_back(read_comparison(snapshot, rows));
  return comparisons;
}

std::vector<ComparisonCandidate> candidates_of(const Snapshot& snapshot, ComparisonId id) {
  Statement rows(database_of(snapshot),
                 "SELECT scan, vantage, distance_m, age, overlap, gain, chosen, reason FROM comparison_candidates "
                 "WHERE comparison = ? ORDER BY place");
  rows.bind(id);
  std::vector<ComparisonCandidate> candidates;
  while (rows.next()) {
    ComparisonCandidate& candidate = candidates.emplace_back();
    candidate.scan = rows.take<ScanId>();
    candidate.vantage = rows.take<VantageId>();
    candidate.distance_m = rows.take<double>();
    candidate.age = rows.take<Duration>();
    candidate.overlap = rows.take<double>();
    candidate.gain = rows.take<double>();
    candidate.chosen = rows.take<bool>();
    candidate.reason = rows.take<std::string>();
  }
  return candidates;
}

}  // namespace raywatch
