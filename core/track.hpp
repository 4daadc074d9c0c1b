#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/change.hpp"
#include "core/compare.hpp"
#include "core/ids.hpp"
#include "core/time.hpp"

namespace raywatch {

enum class TrackState : std::uint8_t {
  open,      ///< as far as can be told, it is still so
  gone,      ///< a scan that could see the place showed that it is not so any more
  accepted,  ///< it became part of what is normal
};
std::string_view to_string(TrackState state);
/// @throws InvalidInput naming the known ones.
TrackState parse_track_state(std::string_view name);

/// What one scan shows of a track.
enum class Sight : std::uint8_t { seen, absent, unseen };
std::string_view to_string(Sight sight);

/// The last so many observations that told something are remembered one by one.
inline constexpr std::uint32_t kRememberedSights = 64;

/// One change followed through time. It is bound to the place where it was first seen: what moves on becomes a chain of
/// short tracks, so that only what stays lasts.
struct Track {
  TrackId id;
  ChangeKind kind = ChangeKind::added;
  TrackState state = TrackState::open;
  Eigen::AlignedBox3d anchor_m;  ///< where it was first seen; never changes
  Change latest;                 ///< as it was seen last
  std::vector<Eigen::Vector3f>
      sample_m;  ///< points (world) of `latest`; scans without a change there are asked about them
  Time first_seen_at, last_seen_at;
  Time last_told_at;  ///< seen or absent
  std::optional<Time> ended_at;
  std::uint64_t seen = 0, absent = 0;
  std::uint64_t recent = 0;      ///< of the last sights that told something, bit 0 the newest; 1: seen
  std::uint32_t remembered = 0;  ///< how many bits of `recent` count
};

/// A new track of a change that was just seen.
Track begin_track(const Change& change, std::vector<Eigen::Vector3f> sample_m, Time at);

/// @{ What a scan of the time `at` adds to a track; one that could not see its place adds nothing. Only an open track,
/// or one that was absent in the scan before, may be given (see `is_followed`).
void see(Track& track, const Change& change, std::vector<Eigen::Vector3f> sample_m, Time at);
void see_still(Track& track, Time at);  ///< no change was found there, yet the place is as it was last seen
void miss(Track& track, Time at);       ///< absent: the track ends, unless the next telling scan sees it again
/// @}

/// Whether later scans may still add to it: it is open, or it ended with the last scan that told something.
bool is_followed(const Track& track);

/// How many of the last `of` sights that told something saw it; `of` is at most `kRememberedSights`.
std::uint32_t seen_of_last(const Track& track, std::uint32_t of);

/// What a scan without a change at a track's place shows of it, from what it answers about the track's sample points:
/// an added thing is gone when its points are free, a removed one when they are occupied again. Unseen unless at least
/// three points and a fifth of them tell something, and three fifths of those agree.
Sight sight_of(ChangeKind kind, std::span<const Answer> answers);

/// For each change the track that it belongs to, as a place in `tracks`, or nothing when it is new. A track and a
/// change belong together when they are of one kind and overlap, give or take half of their size, since two places see
/// different sides of a thing; the nearest pairs are joined first, each track once. A change left over that touches
/// what its neighbour's track already has is a fragment of the same. Discrepancies belong to none.
/// The order of either list does not matter, but for exact ties.
std::vector<std::optional<std::size_t>> associate(std::span<const Track> tracks, std::span<const Change> changes);

/// What is left of `changes` at `places`, put together into new tracks: what touches the largest of a group is a
/// fragment of the same. The largest comes first in its group, and the groups are in the order of their largest.
std::vector<std::vector<std::size_t>> group_fragments(std::span<const Change> changes,
                                                      std::span<const std::size_t> places);

/// How much two boxes differ in their long and short horizontal sides and in their height, together.
double size_difference_m(const OrientedBox& a, const OrientedBox& b);
/// Whether two boxes may be of one object that was moved and perhaps turned, but not tipped over: each side agrees.
bool are_alike(const OrientedBox& a, const OrientedBox& b);

}  // namespace raywatch
