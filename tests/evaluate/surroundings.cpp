#include "tests/evaluate/surroundings.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/cone.hpp"
#include "core/prior_index_impl.hpp"
#include "tests/evaluate/testable.hpp"

namespace raywatch::evaluation {
namespace {

std::vector<Eigen::Vector3d> returns_around(const PriorIndex::Impl& index, const Eigen::Vector3d& point_m,
                                            double angle_rad) {
  std::vector<Eigen::Vector3d> returns;
  const double cosine = std::cos(angle_rad);
  const Direction axis = direction_of(point_m.x(), point_m.y(), point_m.z());
  Cone(angle_rad).for_each_cell(index.grid, axis, [&](std::uint32_t cell, bool inside) {
    for (std::uint32_t i = index.first[cell]; i < index.first[cell + 1]; ++i) {
      const Eigen::Vector3d p = point_of(index.returns[i]);
      if (inside || p.dot(point_m) >= cosine * p.norm() * point_m.norm()) returns.push_back(p);
    }
    return true;
  });
  return returns;
}

void judge_flatness(const std::vector<Eigen::Vector3d>& returns, const Eigen::Vector3d& point_m,
                    Surroundings& surroundings) {
  constexpr std::size_t kLeastReturns = 5;
  constexpr double kFlat_m = 0.05;
  // Returns from before and behind an edge are spread out in every direction across their depth.
  constexpr double kFlatShare = 0.1;
  if (returns.size() < kLeastReturns) return;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : returns) mean_m += p / static_cast<double>(returns.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : returns) {
    scatter += (p - mean_m) * (p - mean_m).transpose() / static_cast<double>(returns.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
  const Eigen::Vector3d spread_m2 = axes.eigenvalues();
  surroundings.flat = spread_m2[0] < kFlat_m * kFlat_m && spread_m2[0] < kFlatShare * spread_m2[1];
  const double cosine = std::abs(axes.eigenvectors().col(0).dot(point_m.normalized()));
  surroundings.incidence_rad = std::acos(std::min(cosine, 1.0));
}

}  // namespace

Surroundings surroundings_of(const ScanView& view, const Eigen::Vector3d& world_m, double margin_m) {
  const Eigen::Vector3d point_m = view.world_from_sensor.inverse() * world_m;
  const std::vector<Eigen::Vector3d> returns = returns_around(view.index.impl(), point_m, testing_angle_rad(view));
  Surroundings surroundings;
  for (const Eigen::Vector3d& p : returns) {
    surroundings.nearer += p.norm() < point_m.norm() - margin_m;
    surroundings.farther += p.norm() > point_m.norm() + margin_m;
  }
  judge_flatness(returns, point_m, surroundings);
  return surroundings;
}

}  // namespace raywatch::evaluation
