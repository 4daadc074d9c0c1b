#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "core/ids.hpp"
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
  std::optional<Eigen::Vector3d> origin_m;  ///< fixed by the first scan when not given
  RetentionLimits retention;                ///< its own: nothing is as configured for all sites, 0 not here
  Time created_at;
};

/// What an edit changes; empty members stay as they are.
struct SiteEdit {
  std::optional<std::string> time_zone;
  std::optional<Profile> profile;
  std::optional<int> epsg;
  std::optional<Eigen::Vector3d> origin_m;  ///< refused (Conflict) once the site has scans or zones
  std::optional<RetentionLimits> retention;
};

/// `id` and `created_at` of the argument are ignored. @throws Conflict when the name is taken.
Site insert_site(Transaction& transaction, const Site& site, Time now);
std::optional<Site> find_site(const Snapshot& snapshot, std::string_view name);
std::optional<Site> find_site(const Snapshot& snapshot, SiteId id);
Page<Site> list_sites(const Snapshot& snapshot, const PageRequest& page);
Site edit_site(Transaction& transaction, SiteId id, const SiteEdit& edit);
/// The site with an origin: if it has none, the place rounded to whole metres when that is farther than 10 km from
/// zero, else zero.
Site fix_origin(Transaction& transaction, const Site& site, const Eigen::Vector3d& place_m);
/// @throws Conflict while the site has sensors.
void delete_site(Transaction& transaction, SiteId id);

}  // namespace raywatch
