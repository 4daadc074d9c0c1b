#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

namespace raywatch {

/// What is known of a coordinate reference system.
struct CrsInfo {
  int epsg = 0;
  std::string name;            ///< "ETRS89 / UTM zone 33N"
  std::string unit;            ///< of the first axis: "metre", "degree", "US survey foot"
  double metres_a_unit = 0.0;  ///< 0 when the unit is an angle
  bool projected = false;      ///< or the horizontal part of a compound one is
  std::string wkt;             ///< OGC WKT 1, as LAS files have it
};

/// Asks PROJ, which is loaded for it. @throws InvalidInput naming `epsg` when PROJ knows no such coordinate reference
/// system; StorageError when PROJ cannot be loaded.
CrsInfo describe_crs(int epsg);

/// Volumes and distances need metres on both axes. @throws InvalidInput naming `epsg`, with the reason, unless the
/// coordinate reference system is projected and its unit is the metre.
void require_metric(const CrsInfo& crs);

/// From a projected coordinate reference system to WGS 84. One thread at a time.
class ToWgs84 {
 public:
  /// @throws as `describe_crs`.
  explicit ToWgs84(int epsg);
  ~ToWgs84();
  ToWgs84(ToWgs84&&) noexcept;
  ToWgs84& operator=(ToWgs84&&) noexcept;

  /// Easting and northing to longitude and latitude in degrees. @throws InvalidInput where PROJ cannot transform it.
  Eigen::Vector2d longitude_latitude_deg(const Eigen::Vector2d& easting_northing) const;

 private:
  struct Transformation;
  std::unique_ptr<Transformation> transformation_;
};

}  // namespace raywatch
