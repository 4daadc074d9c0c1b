#include "tests/support/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace raywatch::testing {
namespace {

double angle_between_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

BruteForceAnswer brute_force_answer(const std::vector<Eigen::Vector3d>& prior_returns_m, const Eigen::Vector3d& point_m,
                                    const Thresholds& thresholds) {
  const double rho = point_m.norm();
  const Eigen::Vector3d u = point_m / rho;
  const double azimuth = std::atan2(u.y(), u.x());
  const double elevation = std::atan2(u.z(), std::hypot(u.x(), u.y()));
  const Eigen::Vector3d east(-std::sin(azimuth), std::cos(azimuth), 0.0);
  const Eigen::Vector3d north(-std::sin(elevation) * std::cos(azimuth), -std::sin(elevation) * std::sin(azimuth),
                              std::cos(elevation));

  bool any = false, all_farther = true, all_nearer = true, supported = false;
  double least_a = std::numeric_limits<double>::infinity(), greatest_a = -least_a;
  double least_e = least_a, greatest_e = -least_a;
  double margin = std::numeric_limits<double>::infinity();
  // Returns that are clearly out of the cone need no angle.
  const double clearly_outside = std::cos(std::min(1.1 * thresholds.angle_rad + 1e-3, std::numbers::pi));
  for (const Eigen::Vector3d& p : prior_returns_m) {
    const double rho_i = p.norm();
    const Eigen::Vector3d u_i = p / rho_i;
    if (u.dot(u_i) < clearly_outside) continue;
    const double angle = angle_between_rad(u, u_i);
    margin = std::min(margin, std::abs(angle - thresholds.angle_rad));
    if (angle > thresholds.angle_rad) continue;
    any = true;
    all_farther &= rho_i >= rho + thresholds.range_m;
    all_nearer &= rho_i <= rho - thresholds.range_m;
    supported |= std::abs(rho_i - rho) < thresholds.range_m;
    margin = std::min(margin, std::abs(std::abs(rho_i - rho) - thresholds.range_m) / std::max(rho, rho_i));
    const double a = u_i.dot(east), e = u_i.dot(north);
    margin = std::min({margin, std::abs(a), std::abs(e)});
    least_a = std::min(least_a, a);
    greatest_a = std::max(greatest_a, a);
    least_e = std::min(least_e, e);
    greatest_e = std::max(greatest_e, e);
  }
  BruteForceAnswer result{.margin = margin};
  if (!any) {
    result.answer = Answer::unseen;
  } else if (all_farther && least_a <= 0.0 && 0.0 <= greatest_a && least_e < 0.0 && 0.0 < greatest_e) {
    result.answer = Answer::free;
  } else if (supported) {
    result.answer = Answer::supported;
  } else if (all_nearer) {
    result.answer = Answer::occluded;
  } else {
    result.answer = Answer::ambiguous;
  }
  return result;
}

std::vector<std::uint8_t> are_free(std::span<const Answer> answers) {
  std::vector<std::uint8_t> free;
  for (const Answer answer : answers) free.push_back(answer == Answer::free);
  return free;
}

std::vector<std::uint8_t> free_points(const PriorIndex& prior, const PointCloud& points,
                                      std::span<const std::uint8_t> valid, const Pose& prior_from_points,
                                      const Thresholds& thresholds) {
  std::vector<std::uint8_t> free(points.size());
  find_free(prior, points, valid, prior_from_points, thresholds, free);
  return free;
}

std::vector<Eigen::Vector3d> usable_returns(const PointCloud& cloud, const UsableRange& usable) {
  std::vector<Eigen::Vector3d> returns;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud[i].cast<double>();
    if (is_usable(p.norm(), usable)) returns.push_back(p);
  }
  return returns;
}

}  // namespace raywatch::testing
