#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// How a scan came into a baseline.
enum class BaselineOrigin : std::uint8_t {
  learned,   ///< among the first of its vantage
  joined,    ///< the first of a vantage from which nothing new was seen that was not normal
  accepted,  ///< an operator accepted what it shows
};
std::string_view to_string(BaselineOrigin origin);

/// A scan that stands for what is normal: everywhere, or in a region.
struct BaselineEntry {
  ScanId scan;
  VantageId vantage;
  BaselineOrigin origin = BaselineOrigin::learned;
  std::optional<Eigen::AlignedBox3d> region_m;  ///< local; inside it entries without a region have no say
  std::int64_t from_version = 0;                ///< entries with a region of one version speak together
};

/// One version of what counts as normal at a site.
struct BaselineVersion {
  SiteId site;
  std::int64_t version = 0;  ///< 1, 2, ... within the site
  std::string kind;          ///< learned, joined, accepted, replaced, emptied, withdrawn
  Time made_at;
  std::string by, note;
};

/// What a new version changes.
struct BaselineEdit {
  std::string kind, by, note;
  std::vector<BaselineEntry> add;  ///< `from_version` is decided here
  bool clear = false;              ///< what was there before goes
};
/// Makes a version and an event. @throws NotFound for the site.
BaselineVersion edit_baseline(Transaction& transaction, SiteId site, const BaselineEdit& edit, Time now);

/// Takes a scan that is to be deleted out of the present baseline, in a version of its own; nothing if it is not in it.
void withdraw_from_baseline(Transaction& transaction, ScanId scan, Time now);

std::optional<BaselineVersion> latest_baseline(const Snapshot& snapshot, SiteId site);
std::optional<BaselineVersion> find_baseline(const Snapshot& snapshot, SiteId site, std::int64_t version);
/// The entries of a version, in the order in which they came.
std::vector<BaselineEntry> baseline_entries(const Snapshot& snapshot, SiteId site, std::int64_t version);
/// The versions of a site, newest first.
Page<BaselineVersion> list_baselines(const Snapshot& snapshot, SiteId site, const PageRequest& page);
/// The latest version of each site, by site.
Page<BaselineVersion> latest_baselines(const Snapshot& snapshot, const PageRequest& page);

/// The present entries of a vantage that speak everywhere.
std::vector<BaselineEntry> baseline_of_vantage(const Snapshot& snapshot, SiteId site, VantageId vantage);
/// The present entries with a region, in the order in which they came.
std::vector<BaselineEntry> baseline_patches(const Snapshot& snapshot, SiteId site);
/// Whether a scan is part of a present baseline.
bool is_in_baseline(const Snapshot& snapshot, ScanId scan);

}  // namespace raywatch
