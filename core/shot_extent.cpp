#include "core/shot_extent.hpp"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/assumed_sensor.hpp"

namespace raywatch {

ShotExtent extent_in_shots(const ScanView& view, std::span<const std::uint32_t> members) {
  const auto count = static_cast<double>(members.size());
  const auto direction_of_member = [&](std::uint32_t i) {
    return Eigen::Vector3d(view.points[i].cast<double>().normalized());
  };
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : members) center += direction_of_member(i) / count;
  Eigen::Vector3d eastward = Eigen::Vector3d::UnitZ().cross(center);
  if (eastward.squaredNorm() == 0.0) eastward = Eigen::Vector3d::UnitX();
  eastward.normalize();
  const Eigen::Vector3d northward = center.cross(eastward).normalized();
  const Eigen::Vector2d spacing_rad = spacing_of(view);

  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (const std::uint32_t i : members) {
    const Eigen::Vector3d direction = direction_of_member(i);
    const Eigen::Vector2d shots =
        Eigen::Vector2d(eastward.dot(direction), northward.dot(direction)).cwiseQuotient(spacing_rad);
    mean += shots / count;
    squares += shots * shots.transpose() / count;
  }
  // The variance of n values a step apart is (n^2 - 1) / 12.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(squares - mean * mean.transpose(), Eigen::EigenvaluesOnly);
  const Eigen::Vector2d extent = (12.0 * axes.eigenvalues().cwiseMax(0.0).array() + 1.0).sqrt();
  return {.length = extent[1], .width = extent[0], .filled = count / extent.prod()};
}

}  // namespace raywatch
