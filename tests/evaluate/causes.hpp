#pragma once

#include <array>
#include <ostream>
#include <vector>

#include "tests/evaluate/indexed_place.hpp"
#include "tests/evaluate/objects.hpp"

namespace raywatch::evaluation {

/// Why a point was judged wrongly: the first that holds.
enum class Cause : std::uint8_t {
  unseen,  ///< missed: no scan could tell what was there (`testable_points`)
  faint,   ///< missed: the object has fewer than 40 returns in the scan that holds the point: thin, small or far
  foot,    ///< within 10 cm of where a changed object meets what stays: missed beside static points, or false beside
           ///< changed ones
  silhouette,  ///< another scan has returns both nearer and farther than the point by more than 10 cm around it
  grazing,     ///< the point's own surface, or what another scan saw there, is flat and met at more than 75 degrees
  other,       ///< noise, and all else
};
inline constexpr std::array<const char*, 6> kCauseNames{"unseen", "faint", "foot", "silhouette", "grazing", "other"};

/// A point that was judged wrongly.
struct PointError {
  bool of_scan = true;
  std::uint32_t prior = 0;  ///< when it is a prior's: which
  std::uint32_t index = 0;
  bool missed = false;  ///< else: false
  Cause cause = Cause::other;
};

/// Every point that is judged wrongly, with its cause. Scan's points first, in order.
std::vector<PointError> find_errors(const CaseViews& views, const CaseLabels& labels, const Verdicts& verdicts);

/// Numbers of errors by cause.
class CauseTable {
 public:
  void add(const std::vector<PointError>& errors);
  void write_markdown(std::ostream& out) const;

  std::size_t count(Cause cause, bool of_scan, bool missed) const {
    return counts_[static_cast<std::size_t>(cause)][column(of_scan, missed)];
  }

 private:
  static constexpr std::size_t kColumns = 4;
  static std::size_t column(bool of_scan, bool missed) { return (of_scan ? 0 : 2) + (missed ? 1 : 0); }
  std::array<std::array<std::size_t, kColumns>, kCauseNames.size()> counts_{};
};

}  // namespace raywatch::evaluation
