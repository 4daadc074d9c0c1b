#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace raywatch {

/// A key of the store. Ids of different things are different types; they start at 1 and are never used again.
template <class Tag>
struct Id {
  std::int64_t value = 0;
  friend auto operator<=>(const Id&, const Id&) = default;
};

using SiteId = Id<struct SiteTag>;
using SensorId = Id<struct SensorTag>;
using VantageId = Id<struct VantageTag>;
using ScanId = Id<struct ScanTag>;
using JobId = Id<struct JobTag>;
using ComparisonId = Id<struct ComparisonTag>;
using ChangeId = Id<struct ChangeTag>;
using TrackId = Id<struct TrackTag>;
using ZoneId = Id<struct ZoneTag>;
using RuleId = Id<struct RuleTag>;
using AlertId = Id<struct AlertTag>;
using SilenceId = Id<struct SilenceTag>;
using EventId = Id<struct EventTag>;

}  // namespace raywatch

template <class Tag>
struct std::hash<raywatch::Id<Tag>> {
  std::size_t operator()(const raywatch::Id<Tag>& id) const noexcept { return std::hash<std::int64_t>{}(id.value); }
};
