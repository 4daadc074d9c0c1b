#include "tests/bench/plain_method.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace raywatch::bench {
namespace {

constexpr double kPi = std::numbers::pi;

double azimuth_of(const Eigen::Vector3d& p) { return std::atan2(p.y(), p.x()); }
double elevation_of(const Eigen::Vector3d& p) { return std::atan2(p.z(), p.head<2>().norm()); }

}  // namespace

PlainMethod::PlainMethod(const PointCloud& prior, const Thresholds& thresholds)
    : thresholds_(thresholds),
      rows_(static_cast<long>(std::ceil(kPi / thresholds.angle_rad))),
      columns_(static_cast<long>(std::floor(2.0 * kPi / thresholds.angle_rad))) {
  std::vector<std::size_t> bins(prior.size());
  first_.assign(static_cast<std::size_t>(rows_ * columns_) + 1, 0);
  for (std::size_t i = 0; i < prior.size(); ++i) {
    const Eigen::Vector3d p = prior[i].cast<double>();
    if (!(p.norm() > 0.0)) continue;
    bins[i] = 1 + bin_of(static_cast<long>((elevation_of(p) + kPi / 2) / kPi * static_cast<double>(rows_)),
                         static_cast<long>((azimuth_of(p) + kPi) / (2.0 * kPi) * static_cast<double>(columns_)));
    ++first_[bins[i]];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::uint32_t> next(first_.begin(), first_.end());
  direction_.resize(first_.back());
  range_m_.resize(first_.back());
  for (std::size_t i = 0; i < prior.size(); ++i) {
    if (bins[i] == 0) continue;
    const std::uint32_t slot = next[bins[i] - 1]++;
    range_m_[slot] = prior[i].cast<double>().norm();
    direction_[slot] = prior[i].cast<double>() / range_m_[slot];
  }
}

std::size_t PlainMethod::bin_of(long row, long column) const {
  return static_cast<std::size_t>(std::clamp(row, 0L, rows_ - 1) * columns_ + (column + columns_) % columns_);
}

bool PlainMethod::is_free(const Eigen::Vector3d& point_m) const {
  const double range_m = point_m.norm();
  if (!(range_m > 0.0)) return false;
  const Eigen::Vector3d u = point_m / range_m;
  const double azimuth = azimuth_of(point_m), elevation = elevation_of(point_m);
  const Eigen::Vector3d east(-std::sin(azimuth), std::cos(azimuth), 0.0);
  const Eigen::Vector3d north = u.cross(east);
  const long row = static_cast<long>((elevation + kPi / 2) / kPi * static_cast<double>(rows_));
  const long column = static_cast<long>((azimuth + kPi) / (2.0 * kPi) * static_cast<double>(columns_));
  const double reach = 1.0 / std::max(0.05, std::cos(elevation));
  const long width = static_cast<long>(std::ceil(reach));
  bool west = false, is_east = false, south = false, is_north = false;
  for (long r = std::max(row - 1, 0L); r <= std::min(row + 1, rows_ - 1); ++r) {
    for (long c = column - width; c <= column + width; ++c) {
      const std::size_t bin = bin_of(r, c);
      for (std::uint32_t i = first_[bin]; i < first_[bin + 1]; ++i) {
        if (std::acos(std::clamp(u.dot(direction_[i]), -1.0, 1.0)) > thresholds_.angle_rad) continue;
        if (range_m_[i] < range_m + thresholds_.range_m) return false;
        const double a = east.dot(direction_[i]), e = north.dot(direction_[i]);
        west |= a <= 0.0;
        is_east |= a >= 0.0;
        south |= e < 0.0;
        is_north |= e > 0.0;
      }
    }
  }
  return west && is_east && south && is_north;
}

std::vector<std::uint8_t> PlainMethod::free(const PointCloud& points, const Pose& prior_from_points) const {
  std::vector<std::uint8_t> free(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) free[i] = is_free(prior_from_points * points[i].cast<double>());
  return free;
}

}  // namespace raywatch::bench
