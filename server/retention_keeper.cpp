#include "server/retention_keeper.hpp"

#include <spdlog/spdlog.h>

#include <vector>

#include "core/error.hpp"
#include "storage/all_of_list.hpp"
#include "storage/deletions.hpp"
#include "storage/payloads.hpp"

namespace raywatch {
namespace {

/// Logs are pruned when this much more than what is kept has gathered, not at each event.
constexpr std::chrono::hours kPruneApart{1};

}  // namespace

bool RetentionKeeper::keep(Time now) {
  const auto end = std::chrono::steady_clock::now() + config_.longest_turn;
  std::vector<Site> sites = store_.read([](const Snapshot& snapshot) {
    return all_of_list([&](const PageRequest& page) { return list_sites(snapshot, page); });
  });
  std::erase_if(sites, [&](const Site& site) { return !is_on(limits_in_force(site.retention, config_.defaults)); });
  bool more = true;
  while (more && std::chrono::steady_clock::now() < end) {
    more = prune_logs(now);
    for (const Site& site : sites) more |= step(site, now);
  }
  return more;
}

bool RetentionKeeper::step(const Site& site, Time now) {
  // While the store is copied, nothing that is deleted makes room.
  if (store_.payloads().deletions_wait()) return false;
  const RetentionState state = retention_state(store_, site.id, limits_in_force(site.retention, config_.defaults), now);
  const RetentionPlan plan = store_.read(
      [&](const Snapshot& snapshot) { return plan_retention(snapshot, site.id, state, config_.scans_at_once); });
  if (plan.expired.empty()) return false;
  const DeletedScans deleted =
      store_.write([&](Transaction& transaction) { return delete_expired(transaction, site.id, plan.expired, now); });
  if (deleted.scans.empty()) return false;
  remove(deleted);
  spdlog::info("{} scans of site {} were deleted, which is {} bytes", deleted.scans.size(), site.name, deleted.bytes);
  return true;
}

void RetentionKeeper::remove(const DeletedScans& deleted) {
  scans_deleted_ += deleted.scans.size();
  bytes_deleted_ += deleted.bytes;
  for (const ScanId scan : deleted.scans) forget_(scan);
  for (const PayloadRef& payload : deleted.payloads) {
    try {
      store_.payloads().remove(payload);
    } catch (const Error& error) {
      spdlog::warn("a payload without an owner stays until the next start: {}", error.what());
    }
  }
  store_.give_back_space(deleted.payloads);
}

bool RetentionKeeper::prune_logs(Time now) {
  const Time horizon = now - config_.events_max_age;
  if (!pruning_) {
    pruning_ = store_.read([&](const Snapshot& snapshot) { return has_old_logs(snapshot, horizon - kPruneApart); });
  }
  if (!pruning_) return false;
  const std::uint64_t pruned =
      store_.write([&](Transaction& transaction) { return raywatch::prune_logs(transaction, horizon, now); });
  events_deleted_ += pruned;
  store_.give_back_space({});
  pruning_ = pruned > 0;
  return pruning_;
}

}  // namespace raywatch
