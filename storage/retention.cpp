#include "storage/retention.hpp"

#include <algorithm>
#include <chrono>
#include <variant>

#include "core/names.hpp"
#include "core/rule.hpp"
#include "storage/columns.hpp"
#include "storage/comparisons.hpp"
#include "storage/epochs.hpp"
#include "storage/scans.hpp"
#include "storage/snapshot.hpp"
#include "storage/storage_use.hpp"

namespace raywatch {
namespace {

constexpr Names<Protection, 7> kProtections{{{Protection::pinned, "pinned"},
                                             {Protection::baseline, "baseline"},
                                             {Protection::alert, "alert"},
                                             {Protection::evidence, "evidence"},
                                             {Protection::unfinished, "unfinished"},
                                             {Protection::survey, "survey"},
                                             {Protection::anchor, "anchor"}}};

using Protected = std::unordered_map<ScanId, Protection>;

/// Adds the scans that a question gives; the first reason stays.
template <class... Args>
void add(const Snapshot& snapshot, Protected& all, Protection why, std::string_view sql, const Args&... args) {
  Statement rows(database_of(snapshot), sql);
  rows.bind(args...);
  while (rows.next()) {
    if (const auto scan = rows.take<std::optional<ScanId>>()) all.emplace(*scan, why);
  }
}

/// The scans by which an alert opened, that its steps name, and that showed its track until it opened; then the priors
/// of the comparisons of all these.
void add_alert(const Snapshot& snapshot, Protected& all, AlertId alert) {
  Protected behind;
  add(snapshot, behind, Protection::alert, "SELECT scan FROM alerts WHERE id = ?", alert);
  add(snapshot, behind, Protection::alert, "SELECT scan FROM alert_steps WHERE alert = ?", alert);
  add(snapshot, behind, Protection::alert,
      "SELECT first_scan FROM tracks WHERE id = (SELECT track FROM alerts WHERE id = ?)", alert);
  add(snapshot, behind, Protection::alert,
      "SELECT last_scan FROM tracks WHERE id = (SELECT track FROM alerts WHERE id = ?)", alert);
  add(snapshot, behind, Protection::alert,
      "SELECT changes.scan FROM alerts CROSS JOIN changes INDEXED BY changes_by_track "
      "ON changes.track = alerts.track AND changes.scan <= alerts.scan WHERE alerts.id = ?",
      alert);
  all.insert(behind.begin(), behind.end());
  for (const auto& [scan, why] : behind) {
    add(snapshot, all, Protection::evidence,
        "SELECT comparison_priors.scan FROM comparisons INDEXED BY comparisons_by_scan CROSS JOIN comparison_priors "
        "ON comparison_priors.comparison = comparisons.id WHERE comparisons.scan = ?",
        scan);
  }
}

void add_alerts(const Snapshot& snapshot, SiteId site, Protected& all) {
  for (const AlertState state : {AlertState::open, AlertState::acknowledged, AlertState::snoozed}) {
    Statement rows(database_of(snapshot),
                   "SELECT id FROM alerts INDEXED BY alerts_by_site_and_state WHERE site = ? AND state = ?");
    rows.bind(site, to_string(state));
    while (rows.next()) add_alert(snapshot, all, rows.take<AlertId>());
  }
}

/// Scans that wait to be compared, or to be compared with.
void add_unfinished(const Snapshot& snapshot, SiteId site, Protected& all) {
  Statement rows(database_of(snapshot),
                 "SELECT jobs.scan, comparisons.reference FROM jobs INDEXED BY jobs_by_turn CROSS JOIN comparisons "
                 "ON comparisons.id = jobs.comparison WHERE jobs.site = ?");
  rows.bind(site);
  while (rows.next()) {
    all.emplace(rows.take<ScanId>(), Protection::unfinished);
    const Reference reference = reference_from_json(rows.take<std::string>());
    if (const auto* named = std::get_if<ExplicitReference>(&reference)) {
      for (const ScanId scan : named->scans) all.emplace(scan, Protection::unfinished);
    }
  }
}

/// What is left of the limits while scans are taken away.
class Demand {
 public:
  explicit Demand(const RetentionState& state)
      : limits_(state.in_force), used_bytes_(state.used_bytes), free_bytes_(state.free_bytes) {
    if (limits_.max_age_days) {
      horizon_ = state.now - std::chrono::days(static_cast<std::int64_t>(*limits_.max_age_days));
    }
  }

  /// Why a scan would have to go, if it would.
  std::optional<DeletionReason> reason_for(Time received_at) const {
    if (horizon_ && received_at < *horizon_) return DeletionReason::age;
    if (limits_.max_bytes && used_bytes_ > *limits_.max_bytes) return DeletionReason::bytes;
    if (limits_.min_free_bytes && free_bytes_ < *limits_.min_free_bytes) return DeletionReason::free_disk;
    return std::nullopt;
  }

  void take_away(std::uint64_t bytes) {
    used_bytes_ -= std::min(bytes, used_bytes_);
    free_bytes_ += bytes;
  }

 private:
  RetentionLimits limits_;
  std::uint64_t used_bytes_, free_bytes_;
  std::optional<Time> horizon_;
};

/// Whether the row of a scan looks like an anchor's, so that only these few are asked about.
std::optional<Protection> protection_of(const Snapshot& snapshot, const Protected& all, ScanId scan,
                                        bool may_be_anchor) {
  if (const auto found = all.find(scan); found != all.end()) return found->second;
  if (!may_be_anchor) return std::nullopt;
  const std::optional<ScanRecord> record = find_scan(snapshot, scan);
  return record && is_anchor(snapshot, *record) ? std::optional(Protection::anchor) : std::nullopt;
}

void note(RetentionPlan& plan, const ExpiredScan& scan) {
  plan.bytes += scan.bytes;
  ++plan.reasons[scan.reason];
  if (!plan.oldest_received_at) plan.oldest_received_at = scan.received_at;
  plan.newest_received_at = scan.received_at;
  plan.expired.push_back(scan);
}

}  // namespace

RetentionLimits limits_in_force(const RetentionLimits& of_site, const RetentionLimits& defaults) {
  const auto chosen = [](const std::optional<std::uint64_t>& own, const std::optional<std::uint64_t>& common) {
    const std::optional<std::uint64_t>& limit = own ? own : common;
    return limit && *limit > 0 ? limit : std::nullopt;
  };
  return {.max_age_days = chosen(of_site.max_age_days, defaults.max_age_days),
          .max_bytes = chosen(of_site.max_bytes, defaults.max_bytes),
          .min_free_bytes = chosen(of_site.min_free_bytes, defaults.min_free_bytes)};
}

RetentionState retention_state(Store& store, SiteId site, const RetentionLimits& in_force, Time now) {
  RetentionState state{.in_force = in_force, .now = now};
  if (!in_force.max_bytes && !in_force.min_free_bytes) return state;
  const PayloadUse use = store.payloads().use_of(site);
  state.used_bytes = use.in_use_bytes;
  state.free_bytes = storage_use(store).free_bytes + use.freed_bytes;
  return state;
}

std::string_view to_string(Protection protection) { return name_of(kProtections, protection); }

std::unordered_map<ScanId, Protection> protected_scans(const Snapshot& snapshot, SiteId site) {
  Protected all;
  add(snapshot, all, Protection::pinned, "SELECT id FROM scans INDEXED BY scans_pinned WHERE site = ? AND pinned = 1",
      site);
  add(snapshot, all, Protection::baseline,
      "SELECT scan FROM baseline_entries INDEXED BY baseline_entries_now WHERE site = ? AND until_version IS NULL",
      site);
  add_alerts(snapshot, site, all);
  add_unfinished(snapshot, site, all);
  for (const ScanId scan : scans_that_surveys_need(snapshot, site)) all.emplace(scan, Protection::survey);
  return all;
}

bool is_anchor(const Snapshot& snapshot, const ScanRecord& scan) {
  const std::optional<ScanRecord> anchor = find_anchor(snapshot, scan.vantage);
  return anchor && anchor->id == scan.id;
}

RetentionPlan plan_retention(const Snapshot& snapshot, SiteId site, const RetentionState& state,
                             std::size_t most_scans) {
  RetentionPlan plan;
  if (!is_on(state.in_force)) return plan;
  Demand demand(state);
  const Protected all = protected_scans(snapshot, site);
  Statement rows(database_of(snapshot),
                 "SELECT id, received_at, registration_state = 'none' AND registration_uncertainty_m IS NOT NULL "
                 "FROM scans INDEXED BY scans_by_receipt WHERE site = ? ORDER BY received_at, id");
  rows.bind(site);
  while (plan.expired.size() < most_scans && rows.next()) {
    ExpiredScan scan{.scan = rows.take<ScanId>(), .received_at = rows.take<Time>()};
    const std::optional<DeletionReason> reason = demand.reason_for(scan.received_at);
    if (!reason) return plan;
    if (const auto kept = protection_of(snapshot, all, scan.scan, rows.take<bool>())) {
      ++plan.kept[*kept];
      continue;
    }
    scan.bytes = bytes_of_scan(snapshot, scan.scan);
    scan.reason = *reason;
    demand.take_away(scan.bytes);
    note(plan, scan);
  }
  plan.reached = !demand.reason_for(Time::max());
  return plan;
}

DeletedScans delete_expired(Transaction& transaction, SiteId site, const std::vector<ExpiredScan>& expired, Time now) {
  DeletedScans deleted;
  const Protected all = protected_scans(transaction, site);
  for (const ExpiredScan& scan : expired) {
    const std::optional<ScanRecord> record = find_scan(transaction, scan.scan);
    if (!record || all.contains(scan.scan) || is_anchor(transaction, *record)) continue;
    record_deleted_scan(transaction, *record, scan.bytes, scan.reason, now);
    const std::vector<PayloadRef> payloads = drop_scan(transaction, *record);
    deleted.payloads.insert(deleted.payloads.end(), payloads.begin(), payloads.end());
    deleted.scans.push_back(scan.scan);
    deleted.bytes += scan.bytes;
  }
  return deleted;
}

}  // namespace raywatch
