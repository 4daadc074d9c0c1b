#pragma once

#include <optional>
#include <string>
#include <vector>

#include "storage/baselines.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"
#include "storage/tracks.hpp"

namespace raywatch {

/// Who accepts something as normal, and why.
struct AcceptedBy {
  std::string by, note;
  Time at;
};

/// Makes what a track shows normal: of each vantage that saw it, the last scan that did becomes the reference in the
/// box around it. The track ends as accepted, and its alerts are resolved.
/// @throws NotFound for the track; Conflict when it is not open.
BaselineVersion accept_track(Transaction& transaction, TrackId track, const AcceptedBy& who);

/// Makes scans the reference: everywhere or in a region (local), beside what was normal before or instead of all of it.
struct AcceptedScans {
  std::vector<ScanId> scans;
  std::optional<Eigen::AlignedBox3d> region_m;
  bool replace = false;
};
/// Open tracks of which that decides end as accepted.
/// @throws NotFound for a scan; InvalidInput when one is of another site or does not fit onto the others.
BaselineVersion accept_scans(Transaction& transaction, SiteId site, const AcceptedScans& accepted,
                             const AcceptedBy& who);

/// Forgets what was normal: the next scans of each vantage are learned anew.
BaselineVersion learn_anew(Transaction& transaction, SiteId site, const AcceptedBy& who);

}  // namespace raywatch
