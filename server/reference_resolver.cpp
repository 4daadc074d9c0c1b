#include "server/reference_resolver.hpp"

#include <optional>
#include <string>

#include "core/error.hpp"
#include "storage/baselines.hpp"

namespace raywatch {
namespace {

/// Bad ones are passed over only until so many are offered.
constexpr std::size_t kMaxOffered = 2 * kMaxVantages;

/// What one reference offers from one vantage, and from names.
class Resolver {
 public:
  Resolver(const Snapshot& snapshot, const ScanRecord& scan, const Site& site, const ReferenceLimits& limits)
      : snapshot_(snapshot), scan_(scan), site_(site), limits_(limits) {}

  std::vector<ScanRecord> operator()(const PreviousReference&) const {
    const Time before = shifted(scan_.captured_at, -limits_.contemporary_tolerance);
    const Time not_before = shifted(scan_.captured_at, -limits_.previous_limit);
    return from_vantages(
        not_before, [&](const Vantage& vantage) { return latest_scan(snapshot_, vantage.id, not_before, before); });
  }

  std::vector<ScanRecord> operator()(const BaselineReference&) const {
    std::vector<ScanRecord> scans;
    for (const Vantage& vantage : near_vantages()) {
      for (const BaselineEntry& entry : baseline_of_vantage(snapshot_, site_.id, vantage.id)) {
        std::optional<ScanRecord> offered = find_scan(snapshot_, entry.scan);
        if (offered && offered->id != scan_.id) scans.push_back(std::move(*offered));
      }
    }
    return scans;
  }

  std::vector<ScanRecord> operator()(const WindowReference& window) const {
    return from_vantages(window.from, [&](const Vantage& vantage) {
      std::optional<ScanRecord> latest = latest_scan(snapshot_, vantage.id, window.from, window.to);
      const bool itself = latest && latest->id == scan_.id;
      return itself ? latest_scan(snapshot_, vantage.id, window.from, scan_.captured_at) : latest;
    });
  }

  std::vector<ScanRecord> operator()(const ExplicitReference& named) const {
    std::vector<ScanRecord> scans;
    for (const ScanId id : named.scans) scans.push_back(named_scan(id));
    return scans;
  }

 private:
  std::vector<Vantage> near_vantages() const {
    const Eigen::Vector3d position_m = local_pose(scan_, site_).position_m;
    std::vector<Vantage> vantages = nearest_vantages(snapshot_, site_.id, position_m, kMaxVantages);
    std::erase_if(vantages,
                  [&](const Vantage& vantage) { return (vantage.position_m - position_m).norm() > limits_.radius_m; });
    return vantages;
  }

  /// One of each vantage. Those that are badly registered stand in the list too, so that the candidates say why they
  /// were not chosen; then the one before is offered in their place.
  template <class Offer>
  std::vector<ScanRecord> from_vantages(Time not_before, const Offer& offer) const {
    std::vector<ScanRecord> scans;
    for (const Vantage& vantage : near_vantages()) {
      std::optional<ScanRecord> offered = offer(vantage);
      while (offered && offered->registration.state == RegistrationState::bad && scans.size() < kMaxOffered) {
        const Time before = offered->captured_at;
        scans.push_back(std::move(*offered));
        offered = latest_scan(snapshot_, vantage.id, not_before, before);
      }
      if (offered) scans.push_back(std::move(*offered));
    }
    return scans;
  }

  ScanRecord named_scan(ScanId id) const {
    const std::string name = "scan " + std::to_string(id.value);
    std::optional<ScanRecord> found = find_scan(snapshot_, id);
    if (!found) throw NotFound(name + " does not exist");
    if (found->id == scan_.id) throw InvalidInput(name + " cannot be compared with itself", {{"reference", name}});
    if (found->site != site_.id) throw InvalidInput(name + " is of another site", {{"reference", name}});
    return std::move(*found);
  }

  const Snapshot& snapshot_;
  const ScanRecord& scan_;
  const Site& site_;
  const ReferenceLimits& limits_;
};

}  // namespace

std::vector<ScanRecord> resolve_reference(const Snapshot& snapshot, const ScanRecord& scan, const Site& site,
                                          const Reference& reference, const ReferenceLimits& limits) {
  return std::visit(Resolver(snapshot, scan, site, limits), reference);
}

std::vector<BaselinePatch> resolve_patches(const Snapshot& snapshot, const ScanRecord& scan, const Site& site,
                                           double radius_m) {
  const Eigen::Vector3d position_m = local_pose(scan, site).position_m;
  std::vector<BaselinePatch> patches;
  std::int64_t version = 0;
  for (const BaselineEntry& entry : baseline_patches(snapshot, site.id)) {
    if (entry.region_m->exteriorDistance(position_m) > radius_m || entry.scan == scan.id) continue;
    std::optional<ScanRecord> found = find_scan(snapshot, entry.scan);
    if (!found) continue;
    if (patches.empty() || entry.from_version != version) patches.push_back({*entry.region_m, {}});
    version = entry.from_version;
    patches.back().scans.push_back(std::move(*found));
  }
  return patches;
}

std::set<ScanId> learned_among(const Snapshot& snapshot, SiteId site, const std::vector<ScanRecord>& scans) {
  std::set<VantageId> vantages;
  for (const ScanRecord& scan : scans) vantages.insert(scan.vantage);
  std::set<ScanId> learned;
  for (const VantageId vantage : vantages) {
    for (const BaselineEntry& entry : baseline_of_vantage(snapshot, site, vantage)) {
      if (entry.origin == BaselineOrigin::learned) learned.insert(entry.scan);
    }
  }
  return learned;
}

bool is_explicit(const Reference& reference) { return std::holds_alternative<ExplicitReference>(reference); }

}  // namespace raywatch
