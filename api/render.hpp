#pragma once

// Internal: only .cpp files of api/ include this.
#include <Eigen/Core>
#include <optional>
#include <string>

#include "api/json.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "storage/comparisons.hpp"
#include "storage/scans.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"

namespace raywatch {

/// @{ Values, as every resource shows them.
Json render(const Eigen::Vector3d& vector);
Json render(const Pose& pose);
Json render(const std::optional<Time>& time);
/// @}

/// What the site's coordinates are relative to; zero until it is fixed.
Eigen::Vector3d origin_of(const Site& site);

/// @{ The records, as JSON. The snapshot gives the names and the other records that they show.
Json render(const Site& site);
Json render(const Snapshot& snapshot, const Sensor& sensor);
Json render(const Snapshot& snapshot, const ScanRecord& scan);
Json render(const Snapshot& snapshot, const Vantage& vantage);
Json render(const Snapshot& snapshot, const ComparisonRecord& comparison);  ///< `progress` is for the caller to add
Json render(const Snapshot& snapshot, const ChangeRecord& change);
Json render(const ComparisonCandidate& candidate);
Json render(const Reference& reference);
/// @}

/// A page of records: {"items", "next"}.
template <class T, class RenderItem>
Json render_page(const Page<T>& page, RenderItem render_item) {
  Json items = Json::array();
  for (const T& item : page.items) items.push_back(render_item(item));
  return {{"items", std::move(items)}, {"next", json_or_null(page.next)}};
}

}  // namespace raywatch
