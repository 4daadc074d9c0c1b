#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "core/point_cloud.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace raywatch::test {

/// What stands before the wall of the place that the tests scan.
struct PlaceState {
  bool box = false;                       ///< a cube of 1 m, 5 m before the scanner
  std::optional<double> person_y_m = {};  ///< somebody 0.6 m wide and 1.8 m high, 7 m before it
};
inline const Eigen::Vector3d kBoxFaceCenter_m{4.5, 0.0, 0.0};  ///< of the side that faces the scanner
inline constexpr std::size_t kBoxPoints = 13 * 13;             ///< returns of a grid of 1 degree from that side

/// A scan of it, as a person would have it: a file that does not say from where and when.
struct PlaceScan {
  PointCloud points;
  Pose world_from_sensor;
  Time captured_at;

  std::string pcd() const;        ///< the bytes of a PCD file
  std::string pose_text() const;  ///< as in the query of an upload
  std::string time_text() const;  ///< RFC 3339
  /// Writes NAME.pcd and its side-car; gives the scan file.
  std::filesystem::path write(const std::filesystem::path& folder, const std::string& name) const;
};

/// The scan number `number` (one a minute). Deterministic.
PlaceScan scan_place(const PlaceState& state, int number);

}  // namespace raywatch::test
