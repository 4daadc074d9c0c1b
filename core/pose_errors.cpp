#include "core/pose_errors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/tukey.hpp"

namespace raywatch {
namespace {

constexpr std::size_t kMostCells = 20000;
/// Heights are not known better than this, whatever their returns say: rounding, and what the ground itself does.
constexpr double kLeastSigma_m = 0.002;

}  // namespace

PoseErrors::PoseErrors(const ElevationModel& before, const ElevationModel& after) : models_{&before, &after} {
  const auto size = static_cast<Eigen::Index>(6 * (before.stations.size() + after.stations.size()));
  mean_ = Eigen::VectorXd::Zero(size);
  covariance_ = Eigen::MatrixXd::Identity(size, size);
}

void PoseErrors::place(std::size_t epoch, std::size_t station, const HeightLeverage& sum, PoseLeverage& into) const {
  const PoseUncertainty& told = models_[epoch]->stations[station].uncertainty;
  const double sign = epoch == 0 ? -1.0 : 1.0;
  const auto at = static_cast<Eigen::Index>(6 * (station + (epoch == 0 ? 0 : models_[0]->stations.size())));
  into.segment<3>(at) = sign * told.position_m * sum.translation;
  into.segment<3>(at + 3) = sign * told.angle_rad * sum.rotation_m;
}

PoseLeverage PoseErrors::leverage_of(std::size_t cell) const {
  PoseLeverage result(mean_.size());
  for (std::size_t e = 0; e < 2; ++e) {
    for (std::size_t k = 0; k < models_[e]->stations.size(); ++k) {
      place(e, k, raywatch::leverage_of(*models_[e], k, cell), result);
    }
  }
  return result;
}

PoseLeverage PoseErrors::leverage_of(std::span<const HeightLeverage> before,
                                     std::span<const HeightLeverage> after) const {
  PoseLeverage result(mean_.size());
  for (std::size_t k = 0; k < before.size(); ++k) place(0, k, before[k], result);
  for (std::size_t k = 0; k < after.size(); ++k) place(1, k, after[k], result);
  return result;
}

void PoseErrors::learn(std::span<const DifferenceCell> difference, std::span<const std::uint8_t> stable) {
  const auto usable = [&](std::size_t cell) { return stable[cell] != 0 && difference[cell].seen(); };
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < difference.size(); ++cell) count += usable(cell) ? 1 : 0;
  const std::size_t stride = count / kMostCells + 1;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(mean_.size(), mean_.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(mean_.size());
  std::size_t place = 0;
  for (std::size_t cell = 0; cell < difference.size(); ++cell) {
    if (!usable(cell) || place++ % stride != 0) continue;
    const PoseLeverage leverage = leverage_of(cell);
    const double sigma_m = std::max(difference[cell].random_sigma_m, kLeastSigma_m);
    const double left_m = difference[cell].rise_m - rise(leverage);
    const double weight =
        tukey_weight(left_m / std::sqrt(sigma_m * sigma_m + variance(leverage))) / (sigma_m * sigma_m);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(leverage, weight);
    right += weight * difference[cell].rise_m * leverage;
  }
  const Eigen::LLT<Eigen::MatrixXd> solver(normal.selfadjointView<Eigen::Lower>());
  mean_ = solver.solve(right);
  covariance_ = solver.solve(Eigen::MatrixXd::Identity(mean_.size(), mean_.size()));
}

}  // namespace raywatch
