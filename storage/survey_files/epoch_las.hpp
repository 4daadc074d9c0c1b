#pragma once

#include <iosfwd>
#include <span>
#include <string>

#include "core/epoch.hpp"
#include "core/output_frame.hpp"

namespace raywatch {

/// LAS has no classes of change: those that users may define begin at 64, and ours are 64 + the value of `PointClass`.
/// The file names them in its classification lookup, too.
inline constexpr std::uint8_t kFirstLasClass = 64;

/// The points of an epoch, all scans together, as LAS 1.4 with point format 6 (LAS 1.4 R15, tables 3 and 16): 1 mm
/// coordinates, classes, the number of the scan (from 1) as point source, the capture time of its scan as adjusted
/// standard GPS time, intensity when the scan has one in 0..65535. Points that are no measurement are left out.
struct EpochLas {
  const EpochScans& scans;
  std::span<const EpochPoints> about;  ///< one a scan
  OutputFrame frame = {};
  std::string wkt = {};  ///< of the output's coordinate reference system; empty: none
  std::string program_version = {};
};
/// @throws StorageError when the stream fails; InvalidInput when a place does not fit, more than 2,100 km from the
/// first.
void write_las(std::ostream& out, const EpochLas& epoch);

}  // namespace raywatch
