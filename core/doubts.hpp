#pragma once

namespace raywatch {

// By how much the log-odds of a change fall when a cluster looks as things that stay often do: it must be so much
// surer.

/// In a room: a line of shots or what is full of gaps, and a flat side that the asked scan meets edge-on.
inline constexpr double kDoubtOfRemnant = 3.6, kDoubtOfEdgeOn = 2.0;
/// Outdoors: a piece of a fence, leaves near a sensor, a strip that rays may have passed, what stands between the shots
/// of the asked scan, and what no ray went through: through many a thing that stays no ray happens to pass but beside
/// it, as past a post or the edge of a roof that is narrower than the shots of a far scan are apart.
inline constexpr double kDoubtOfFence = 3.5, kDoubtOfLeaves = 3.0, kDoubtOfStrip = 2.5, kDoubtOfBetweenShots = 2.0,
                        kDoubtOfNoRay = 1.5;

}  // namespace raywatch
