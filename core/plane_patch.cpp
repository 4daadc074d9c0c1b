#include "core/plane_patch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/assumed_sensor.hpp"
#include "core/cone.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

/// Half-width of a patch: so many spacings of the shots at least and at most, and in between so many standard
/// deviations of the range noise.
constexpr double kLeastSpacings = 1.5;
constexpr double kMostSpacings = 8.0;
constexpr double kNoiseWidths = 6.0;
/// More returns than these make a patch no better, only slower.
constexpr double kMostReturns = 60.0;
constexpr std::size_t kLeastReturns = 5;
/// A normal that is less certain than this is none.
constexpr double kNormalSigmaLimit_rad = 0.12;
/// No scanner, and no surface, is better than this.
constexpr double kLeastNoise_m = 0.002;
/// Returns whose positions spread by less than this, see `OnTwoLines`, lie on two lines.
constexpr double kLeastSpread = 0.1;

/// Tells whether directions lie on two rows or two columns of shots. A plane goes through any two parallel lines, also
/// when one of them is the floor and the other the wall behind it, and what is left of the fit does not show that.
/// By Pearson's inequality (1916) the kurtosis of any distribution is at least 1 + skewness^2, and equal to it only
/// when there are but two values; three equally frequent ones, a step apart, exceed it by 0.5.
class OnTwoLines {
 public:
  /// @param position across columns and across rows, in any unit.
  void add(const Eigen::Array2d& position) {
    Eigen::Array2d power = position;
    for (Eigen::Array2d& sum : sums_) {
      sum += power;
      power *= position;
    }
    ++count_;
  }

  bool operator()() const {
    const auto n = static_cast<double>(count_);
    const Eigen::Array2d mean = sums_[0] / n, second = sums_[1] / n, third = sums_[2] / n, fourth = sums_[3] / n;
    const Eigen::Array2d variance = second - mean.square();
    const Eigen::Array2d cube = third - 3.0 * mean * second + 2.0 * mean.cube();
    const Eigen::Array2d tesseract =
        fourth - 4.0 * mean * third + 6.0 * mean.square() * second - 3.0 * mean.square().square();
    const Eigen::Array2d spread = tesseract / variance.square() - cube.square() / variance.cube() - 1.0;
    return !(spread > kLeastSpread).all();
  }

 private:
  std::array<Eigen::Array2d, 4> sums_{Eigen::Array2d::Zero(), Eigen::Array2d::Zero(), Eigen::Array2d::Zero(),
                                      Eigen::Array2d::Zero()};  ///< of the positions' first to fourth powers
  std::size_t count_ = 0;
};

}  // namespace

/// The sums that the fit needs, on which sides of the direction there are returns, and in how many lines.
struct PatchFitter::Moments {
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  double inverse_squares_per_m2 = 0.0;
  std::size_t count = 0;
  bool west = false, east = false, south = false, north = false;
  OnTwoLines on_two_lines;

  void add(const Eigen::Vector3d& p, const Eigen::Vector3d& around) {
    const double inverse_per_m = 1.0 / p.norm();
    const Eigen::Vector3d u = p * inverse_per_m;
    directions += u * u.transpose();
    weighted += u * inverse_per_m;
    inverse_squares_per_m2 += inverse_per_m * inverse_per_m;
    ++count;
    const double a = around.x() * p.y() - around.y() * p.x();
    const double e = p.z() * around.head<2>().squaredNorm() - around.z() * p.head<2>().dot(around.head<2>());
    west |= a <= 0.0;
    east |= a >= 0.0;
    south |= e < 0.0;
    north |= e > 0.0;
    on_two_lines.add({a * inverse_per_m, e * inverse_per_m});
  }
  bool surround() const { return west && east && south && north; }
};

PatchFitter::PatchFitter(const ScanView& scan) : index_(scan.index.impl()) {
  const Eigen::Vector2d resolution = spacing_of(scan);
  spacing_rad_ = resolution.maxCoeff();
  shot_sr_ = resolution.prod();
  noise_m_ = std::max(noise_of(scan), kLeastNoise_m);
}

double PatchFitter::half_angle_rad(double range_m) const {
  const double widest = std::min(kMostSpacings * spacing_rad_, 0.25 * std::numbers::pi);
  return std::clamp(kNoiseWidths * noise_m_ / range_m, std::min(kLeastSpacings * spacing_rad_, widest), widest);
}

PatchFitter::Moments PatchFitter::gather(const Eigen::Vector3d& point_m) const {
  Moments moments;
  const double range_m = point_m.norm(), angle_rad = half_angle_rad(range_m);
  const double expected = std::numbers::pi * angle_rad * angle_rad / shot_sr_;
  const auto stride = static_cast<std::uint32_t>(std::max(1.0, expected / kMostReturns));
  const double cosine = std::cos(angle_rad);
  Cone(angle_rad).for_each_cell(index_.grid, direction_of(point_m.x(), point_m.y(), point_m.z()),
                                [&](std::uint32_t cell, bool inside) {
                                  for (std::uint32_t i = index_.first[cell]; i < index_.first[cell + 1]; ++i) {
                                    if (!is_chosen(index_.returns[i], stride)) continue;
                                    const Eigen::Vector3d p = point_of(index_.returns[i]);
                                    if (inside || p.dot(point_m) >= cosine * p.norm() * range_m)
                                      moments.add(p, point_m);
                                  }
                                  return true;
                                });
  return moments;
}

std::optional<PlanePatch> PatchFitter::operator()(const Eigen::Vector3d& point_m) const {
  const Moments moments = gather(point_m);
  if (moments.count < kLeastReturns || !moments.surround() || moments.on_two_lines()) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> solver(moments.directions);
  if (solver.info() != Eigen::Success || solver.rcond() < 1e-12) return std::nullopt;
  PlanePatch patch{.n_per_m = solver.solve(moments.weighted)};
  const Eigen::Vector3d u = point_m.normalized();
  const double inverse_per_m = patch.n_per_m.dot(u);
  if (!(inverse_per_m > 0.0)) return std::nullopt;

  // An error of a range by s moves the inverse range by s / rho^2, and the plane by s times the cosine of the
  // incidence.
  const double cosine = inverse_per_m / patch.n_per_m.norm();
  const Eigen::Matrix3d inverse = solver.solve(Eigen::Matrix3d::Identity());
  const double misfit_per_m2 = moments.inverse_squares_per_m2 - patch.n_per_m.dot(moments.weighted);
  const double freedom = static_cast<double>(moments.count) - 3.0 + 1e-9;
  const double roughness_m = std::sqrt(std::max(0.0, misfit_per_m2) / freedom) / inverse_per_m / patch.n_per_m.norm();
  if (roughness_m > 2.0 * noise_m_ * cosine + 0.005) return std::nullopt;
  patch.sigma_m = noise_m_ * cosine * std::sqrt(u.dot(inverse * u));
  patch.normal_sigma_rad = noise_m_ * inverse_per_m * cosine * std::sqrt(0.5 * inverse.trace());
  if (patch.normal_sigma_rad > kNormalSigmaLimit_rad) return std::nullopt;
  return patch;
}

}  // namespace raywatch
