#include "core/align.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/align_evidence.hpp"
#include "core/align_sample.hpp"
#include "core/names.hpp"
#include "core/plane_patch.hpp"
#include "core/tukey.hpp"

namespace raywatch {
namespace {

constexpr Names<RegistrationState, 4> kRegistrationStates{{{RegistrationState::none, "none"},
                                                           {RegistrationState::good, "good"},
                                                           {RegistrationState::moved, "moved"},
                                                           {RegistrationState::bad, "bad"}}};

constexpr int kMostIterations = 40;
/// A step smaller than this is the end.
constexpr double kStepEnd_m = 2e-5;
constexpr double kStepEnd_rad = 2e-6;
/// Poses may be off by far more than the noise. Therefore surfaces are at first taken to be uncertain by this, and by
/// half of it in each further iteration, until the noise decides.
constexpr double kFirstBlur_m = 0.1;
constexpr double kLastBlur_m = 0.0005;
/// Surfaces farther apart than this many deviations do not agree.
constexpr double kAgree = 3.5;
/// The distances of a good fit may spread by this much more than the noise says.
constexpr double kMostSpread = 3.0;
/// A motion that stays more uncertain than this share of what a pose may be off is not fixed by the scene.
constexpr double kMostUncertainty = 0.2;
/// Of a direction that a smaller share of the surfaces faces, their agreement is not asked: one car that drove away is
/// no bad registration.
constexpr double kLeastEvidence = 0.1;
/// Where the agreeing surfaces leave a motion free, others may say that they do not fit at all; so many are needed, and
/// a smaller share of them than this must agree.
constexpr double kLeastObjections = 8.0;
constexpr double kObjection = 0.25;
/// Pieces of surface whose normals differ by more than 30 degrees are not the same.
constexpr double kSameNormal_cosine = 0.866;
/// What the surfaces of two scans differ by besides their noise.
constexpr double kModelError_m = 0.002;
constexpr double kModelError_per_m = 1e-4;

/// The pieces of surface of one reference, kept from one iteration to the next as long as the direction is the same.
struct Remembered {
  Eigen::Vector3d asked_m = Eigen::Vector3d::Zero();
  std::optional<PlanePatch> patch;
};

Eigen::Quaterniond turn_by(const Eigen::Vector3d& turn_rad) {
  const double angle_rad = turn_rad.norm();
  if (angle_rad == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, turn_rad / angle_rad));
}

/// One scan's fitting; its steps in the order in which `run` goes through them.
class Fitting {
 public:
  Fitting(const ScanView& scan, std::span<const ScanView> references, const AlignParameters& parameters)
      : scan_(scan), references_(references), parameters_(parameters), world_from_scan_(scan.world_from_sensor) {
    for (const ScanView& reference : references) fitters_.emplace_back(reference);
    sample_ = sample_surface(scan, parameters.sample);
    remembered_.resize(sample_.size() * references.size());
    rows_.resize(remembered_.size());
    scale_.setOnes();
    double squares_m2 = 0.0;
    for (const SurfaceSample& piece : sample_) squares_m2 += piece.point_m.squaredNorm();
    if (squares_m2 > 0.0) scale_.tail<3>() /= std::sqrt(squares_m2 / static_cast<double>(sample_.size()));
  }

  Alignment run() {
    bool settled = false;
    for (int i = 0; i < kMostIterations && !settled && !is_hopeless(); ++i) {
      settled = step() && blur_m_ == 0.0;
      blur_m_ = blur_m_ > kLastBlur_m ? 0.5 * blur_m_ : 0.0;
    }
    look();
    return judge(settled);
  }

 private:
  void look() {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows_.size(), 64), [&](const auto& block) {
      for (std::size_t i = block.begin(); i < block.end(); ++i) {
        rows_[i] = row_of(sample_[i / references_.size()], i % references_.size(), remembered_[i]);
      }
    });
  }

  /// The reference's surface around a direction; the former one, if the direction has hardly changed.
  static const std::optional<PlanePatch>& patch_at(const Eigen::Vector3d& point_m, const PatchFitter& fitter,
                                                   Remembered& remembered) {
    const double near_m = 0.25 * fitter.spacing_rad() * point_m.norm();
    if ((remembered.asked_m - point_m).norm() > near_m) remembered = {point_m, fitter(point_m)};
    return remembered.patch;
  }

  Row row_of(const SurfaceSample& piece, std::size_t reference, Remembered& remembered) const {
    const Pose& world_from_reference = references_[reference].world_from_sensor;
    const Eigen::Vector3d offset_m = world_from_scan_.orientation * piece.point_m;
    const Eigen::Vector3d point_m = world_from_reference.inverse() * (world_from_scan_.position_m + offset_m);
    const std::optional<PlanePatch>& patch = patch_at(point_m, fitters_[reference], remembered);
    Row row;
    if (!patch) return row;
    const Eigen::Vector3d normal = world_from_reference.orientation * patch->normal();
    const Eigen::Vector3d own_normal = world_from_scan_.orientation * piece.normal;
    const double model_error_m = kModelError_m + kModelError_per_m * std::max(point_m.norm(), piece.point_m.norm());
    row.distance_m = patch->distance_before_m(point_m);
    row.sigma_m =
        std::sqrt(patch->sigma_m * patch->sigma_m + piece.sigma_m * piece.sigma_m + model_error_m * model_error_m);
    row.motion << normal, offset_m.cross(normal);
    row.own_motion << own_normal, offset_m.cross(own_normal);
    row.kind = Row::Kind::comparable;
    if (row.distance_m < -parameters_.search_m) row.kind = Row::Kind::hidden;
    if (row.distance_m > parameters_.search_m) row.kind = Row::Kind::contradicts;
    const bool same_surface = normal.dot(own_normal) > kSameNormal_cosine;
    if (row.kind == Row::Kind::comparable && !same_surface) row.kind = Row::Kind::contradicts;
    return row;
  }

  /// How much more than their deviations the distances spread: from their median, so that what changed has no say.
  double spread() const {
    std::vector<double> deviations;
    for (const Row& row : rows_) {
      if (row.kind == Row::Kind::comparable) deviations.push_back(std::abs(row.deviations(blur_m_)));
    }
    if (deviations.empty()) return 1.0;
    const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
    std::nth_element(deviations.begin(), middle, deviations.end());
    return std::max(1.0, 1.4826 * *middle);
  }

  /// One step of the Gauss-Newton method; true when it was too small to matter.
  bool step() {
    look();
    const double spread_now = spread();
    Information information;
    for (const Row& row : rows_) {
      if (row.kind != Row::Kind::comparable) continue;
      const double sigma_m = row.sigma_with(blur_m_);
      information.add(row, tukey_weight(row.distance_m / sigma_m, spread_now) / (sigma_m * sigma_m), scale_);
    }
    const Motions fixed = information.fixed_motions(most_sigma_m());
    if (fixed.cols() == 0) return true;
    const MotionForm normal = fixed.transpose() * information.normal * fixed;
    const Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1> along =
        normal.ldlt().solve(-fixed.transpose() * information.gradient);
    const Vector6 motion = (fixed * along).cwiseProduct(scale_);
    world_from_scan_.position_m += motion.head<3>();
    world_from_scan_.orientation = (turn_by(motion.tail<3>()) * world_from_scan_.orientation).normalized();
    return motion.head<3>().norm() < kStepEnd_m && motion.tail<3>().norm() < kStepEnd_rad;
  }

  Pose correction() const {
    Pose correction{world_from_scan_.orientation * scan_.world_from_sensor.orientation.conjugate(), {}};
    correction.position_m = world_from_scan_.position_m - correction.orientation * scan_.world_from_sensor.position_m;
    return correction;
  }

  /// A correction far beyond anything that projective association can find is an escape, not a fit.
  bool is_hopeless() const {
    const PoseUncertainty size = size_of(correction(), scan_.world_from_sensor);
    return size.position_m > 6.0 * parameters_.search_m || size.angle_rad > 1.0;
  }

  Alignment judge(bool settled) const {
    Alignment result;
    Information agreeing;
    Eigen::Matrix3d faced = Eigen::Matrix3d::Zero(), faced_agreeing = faced;
    double squares_m2 = 0.0;
    std::size_t seen = 0;
    const double spread_allowed = std::min(spread(), kMostSpread);
    for (const Row& row : rows_) {
      if (row.kind == Row::Kind::unseen || row.kind == Row::Kind::hidden) continue;
      ++seen;
      const Eigen::Vector3d normal = row.motion.head<3>();
      faced += normal * normal.transpose();
      const bool agrees =
          row.kind == Row::Kind::comparable &&
          std::abs(row.distance_m) <= std::max(parameters_.agree_m, kAgree * spread_allowed * row.sigma_m);
      if (!agrees) continue;
      ++result.matches;
      agreeing.add(row, 1.0 / (row.sigma_m * row.sigma_m), scale_);
      faced_agreeing += normal * normal.transpose();
      squares_m2 += row.distance_m * row.distance_m;
    }
    const double sampled = std::max(1.0, static_cast<double>(sample_.size()));
    if (seen < parameters_.least_matches || static_cast<double>(seen) / sampled < parameters_.least_overlap) {
      return {.uncertainty = parameters_.reported};
    }
    result.inliers = static_cast<double>(result.matches) / static_cast<double>(seen);
    if (result.matches > 0) result.residual_m = std::sqrt(squares_m2 / static_cast<double>(result.matches));
    result.agreement = least_agreement(faced_agreeing, faced, kLeastEvidence * faced.trace());
    const Motions fixed = agreeing.fixed_motions(most_sigma_m());
    result.free_directions = static_cast<std::size_t>(6 - fixed.cols());
    result.uncertainty = agreeing.uncertainty({fixed, scale_, spread(), parameters_.reported});
    const double objected = least_agreement(faced_agreeing, faced, kLeastObjections);
    if (result.free_directions > 0 && objected < kObjection) result.agreement = std::min(result.agreement, objected);
    decide(settled, result);
    return result;
  }

  double most_sigma_m() const { return kMostUncertainty * parameters_.tolerance.position_m; }

  double nearest_reference_m() const {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const ScanView& reference : references_) {
      const Eigen::Vector3d apart_m = reference.world_from_sensor.position_m - scan_.world_from_sensor.position_m;
      nearest_m = std::min(nearest_m, apart_m.norm());
    }
    return nearest_m;
  }

  void decide(bool settled, Alignment& result) const {
    const Pose found = correction();
    const PoseUncertainty size = size_of(found, scan_.world_from_sensor);
    // An error of a reference's orientation swings the scan around the reference.
    const double allowed_m = parameters_.tolerance.position_m + parameters_.tolerance.angle_rad * nearest_reference_m();
    const bool within = size.position_m <= allowed_m && size.angle_rad <= parameters_.tolerance.angle_rad;
    const double needed = within ? parameters_.least_agreement : parameters_.least_agreement_moved;
    if (!settled || is_hopeless() || result.agreement < needed) {
      // What both scans show contradicts the pose, or could not refine it: its error may well be larger than reported.
      constexpr double kDoubt = 3.0;
      result.state = RegistrationState::bad;
      result.uncertainty = {kDoubt * parameters_.reported.position_m, kDoubt * parameters_.reported.angle_rad};
      return;
    }
    result.correction = found;
    result.state = within ? RegistrationState::good : RegistrationState::moved;
  }

  const ScanView& scan_;
  std::span<const ScanView> references_;
  const AlignParameters& parameters_;
  Pose world_from_scan_;
  std::vector<PatchFitter> fitters_;
  std::vector<SurfaceSample> sample_;
  std::vector<Remembered> remembered_;  ///< by piece, then reference
  std::vector<Row> rows_;               ///< the same order
  Vector6 scale_;
  double blur_m_ = kFirstBlur_m;
};

}  // namespace

std::string_view to_string(RegistrationState state) { return name_of(kRegistrationStates, state); }
RegistrationState parse_registration_state(std::string_view name) {
  return value_of(kRegistrationStates, name, "registration state");
}

PoseUncertainty size_of(const Pose& correction, const Pose& reported) {
  return {(correction * reported.position_m - reported.position_m).norm(), angle_between_rad(correction, Pose{})};
}

Alignment align(const ScanView& scan, std::span<const ScanView> references, const AlignParameters& parameters) {
  if (references.empty()) return {.uncertainty = parameters.reported};
  return Fitting(scan, references, parameters).run();
}

}  // namespace raywatch
