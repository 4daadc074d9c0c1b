#pragma once

#include <cstdint>
#include <vector>

#include "core/compare.hpp"

namespace raywatch {

/// The scans of one or several stations that show one state of a place: an epoch of a survey.
struct EpochScans {
  std::vector<ScanView> scans;
  /// One a scan: scans of equal number were taken from one set-up of the instrument, so that one error of the pose
  /// holds for all of them.
  std::vector<std::uint32_t> stations;

  void add(const ScanView& scan, std::uint32_t station) {
    scans.push_back(scan);
    stations.push_back(station);
  }
};

}  // namespace raywatch
