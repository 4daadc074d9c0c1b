#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "core/ids.hpp"
#include "core/output_frame.hpp"
#include "core/profile.hpp"
#include "core/time.hpp"
#include "storage/page.hpp"
#include "storage/retention_limits.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// One local metric coordinate frame. What the store keeps about places is relative to `origin_m` ("local"); what goes
/// out to users has it added back in double.
struct Site {
  SiteId id;
  std::string name;
  std::string time_zone = "UTC";  ///< IANA name
  Profile profile = Profile::indoor;
  std::optional<int> epsg;
  std::optional<MineGrid> mine_grid;        ///< results go out in it; not with an EPSG code
  std::optional<Eigen::Vector3d> origin_m;  ///< fixed by the first scan when not given
  RetentionLimits retention;                ///< its own: nothing is as configured for all sites, 0 not here
  Time created_at;
};

/// What an edit changes; empty members stay as they are. An EPSG code or a mine grid that is given as nothing is taken
/// away.
struct SiteEdit {
  std::optional<std::string> time_zone;
  std::optional<Profile> profile;
  std::optional<std::optional<int>> epsg;
  std::optional<std::optional<MineGrid>> mine_grid;
  std::optional<Eigen::Vector3d> origin_m;  ///< refused (Conflict) once the site has scans or zones
  std::optional<RetentionLimits> retention;
};

/// `id` and `created_at` of the argument are ignored. @throws Conflict when the name is taken; InvalidInput when it has
/// both an EPSG code and a mine grid, or a grid that `check_grid` refuses.
Site insert_site(Transaction& transaction, const Site& site, Time now);
std::optional<Site> find_site(const Snapshot& snapshot, std::string_view name);
std::optional<Site> find_site(const Snapshot& snapshot, SiteId id);
Page<Site> list_sites(const Snapshot& snapshot, const PageRequest& page);
/// @throws as `insert_site`, of the site as it would be.
Site edit_site(Transaction& transaction, SiteId id, const SiteEdit& edit);
/// In which coordinates results of the site go out.
OutputFrame output_frame(const Site& site);
/// The site with an origin: if it has none, the place rounded to whole metres when that is farther than 10 km from
/// zero, else zero.
Site fix_origin(Transaction& transaction, const Site& site, const Eigen::Vector3d& place_m);
/// @throws Conflict while the site has sensors.
void delete_site(Transaction& transaction, SiteId id);

}  // namespace raywatch
