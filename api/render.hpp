#pragma once

// Heavy: only .cpp files include this.
#include <Eigen/Core>
#include <optional>
#include <string>

#include "api/json.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "storage/alerts.hpp"
#include "storage/baselines.hpp"
#include "storage/channels.hpp"
#include "storage/comparisons.hpp"
#include "storage/deletions.hpp"
#include "storage/deliveries.hpp"
#include "storage/events.hpp"
#include "storage/rules.hpp"
#include "storage/scans.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"
#include "storage/tracks.hpp"
#include "storage/zones.hpp"

namespace raywatch {

/// @{ Values, as every resource shows them.
Json render(const Eigen::Vector3d& vector);
Json render(const Pose& pose);
Json render(const std::optional<Time>& time);
/// @}

/// What the site's coordinates are relative to; zero until it is fixed.
Eigen::Vector3d origin_of(const Site& site);

/// @{ The records, as JSON. The snapshot gives the names and the other records that they show.
Json render(const RetentionLimits& limits);
Json render(const Site& site);
Json render(const Snapshot& snapshot, const Sensor& sensor);
Json render(const Snapshot& snapshot, const ScanRecord& scan);
Json render(const Snapshot& snapshot, const Vantage& vantage);
Json render(const Snapshot& snapshot, const ComparisonRecord& comparison);  ///< `progress` is for the caller to add
Json render(const Snapshot& snapshot, const ChangeRecord& change);
Json render(const ComparisonCandidate& candidate);
Json render(const Reference& reference);
Json render(const CompareParameters& parameters);
Json render(const Snapshot& snapshot, const ZoneRecord& zone);
Json render(const ZoneCoverage& coverage);
Json render(const Snapshot& snapshot, const RuleRecord& rule);
Json render(const Snapshot& snapshot, const SilenceRecord& silence);
Json render(const Snapshot& snapshot, const TrackRecord& track);
Json render(const SightRun& run);
Json render(const Snapshot& snapshot, const AlertRecord& alert);
Json render(const AlertHistoryStep& step);
Json render(const Snapshot& snapshot, const BaselineVersion& version);  ///< with its entries
Json render(const Snapshot& snapshot, const Event& event);
Json render(const Snapshot& snapshot, const ChannelRecord& channel);  ///< without its secrets
Json render(const Snapshot& snapshot, const DeliveryRecord& delivery);
Json render(const Snapshot& snapshot, const DeletionRecord& deletion);
/// @}

/// The id of something, or null.
template <class SomeId>
Json id_or_null(const std::optional<SomeId>& id) {
  return id ? Json(id->value) : Json(nullptr);
}

/// What a rule says, without what names it.
Json render_rule_body(const Rule& rule);
/// Where and how large a change is, in the coordinates of its site.
Json render_figures(const Change& change, const Eigen::Vector3d& origin_m);

/// A page of records: {"items", "next"}.
template <class T, class RenderItem>
JsonText render_page(const Page<T>& page, RenderItem render_item) {
  std::string text = R"({"items":[)";
  for (const T& item : page.items) {
    if (&item != &page.items.front()) text += ',';
    text += to_json_text(render_item(item));
  }
  return {text + R"(],"next":)" + to_json_text(json_or_null(page.next)) + "}"};
}

}  // namespace raywatch
