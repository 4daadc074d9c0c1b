#pragma once

#include <optional>
#include <vector>

#include "core/rule.hpp"
#include "storage/sites.hpp"
#include "storage/store.hpp"

namespace raywatch {

/// An alert that a rule would have raised.
struct RehearsedAlert {
  TrackId track;
  ScanId scan;  ///< by which it would have opened
  Time at;      ///< when that was taken
  Severity severity = Severity::warning;
  std::optional<Time> resolved_at;  ///< when a scan showed the change gone
};

/// What a rule would have raised by the scans taken in [from, to), exactly as if it had been there all the time: the
/// tracks of the site are judged again, sight by sight, with the zones and silences as they are now.
/// In the order in which the alerts would have opened.
std::vector<RehearsedAlert> rehearse(const Snapshot& snapshot, const Rule& rule, const Site& site, Time from, Time to);

}  // namespace raywatch
