#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <utility>

#include "core/align.hpp"

namespace raywatch {
namespace {

std::string warning_of_bad(std::size_t prior, const Alignment& alignment, bool is_left_out) {
  char text[320];
  std::snprintf(text, sizeof text,
                "Prior %zu does not fit onto the scan (%.0f %% of the surfaces that both show agree; in one direction "
                "%.0f %%): its pose is wrong, or nearly everything changed. %s",
                prior, 100.0 * alignment.inliers, 100.0 * alignment.agreement,
                is_left_out ? "It is left out, as other priors fit."
                            : "It is compared at its pose as reported; changes may be errors of that pose.");
  return text;
}

std::string warning_of_moved(std::size_t prior, const PoseUncertainty& size) {
  char text[240];
  std::snprintf(text, sizeof text,
                "Prior %zu fits onto the scan only when it is moved by %.3g m and turned by %.3g degrees; it is "
                "compared as corrected.",
                prior, size.position_m, size.angle_rad * 180.0 / std::numbers::pi);
  return text;
}

}  // namespace

Pose with_origin(const Pose& correction, const Eigen::Vector3d& origin_m) {
  return {correction.orientation, correction.position_m + origin_m - correction.orientation * origin_m};
}

AlignedPriors align_priors(const ScanView& scan, std::span<const ScanView> priors, const AlignParameters& parameters) {
  AlignedPriors aligned;
  for (const ScanView& prior : priors) aligned.alignments.push_back(align(prior, {&scan, 1}, parameters));
  const bool any_fits = std::any_of(aligned.alignments.begin(), aligned.alignments.end(),
                                    [](const Alignment& found) { return found.state != RegistrationState::bad; });
  for (std::size_t p = 0; p < priors.size(); ++p) {
    const ScanView& prior = priors[p];
    const Alignment& found = aligned.alignments[p];
    const bool is_bad = found.state == RegistrationState::bad;
    if (is_bad) aligned.warnings.push_back(warning_of_bad(p, found, any_fits));
    if (is_bad && any_fits) continue;
    if (found.state == RegistrationState::moved) {
      aligned.warnings.push_back(warning_of_moved(p, size_of(found.correction, prior.world_from_sensor)));
    }
    aligned.places.push_back(static_cast<std::uint32_t>(p));
    aligned.usable.push_back({prior.points, prior.index, found.correction * prior.world_from_sensor, prior.captured_at,
                              prior.sensor, found.uncertainty});
  }
  return aligned;
}

void restore_places(const AlignedPriors& aligned, Comparison& comparison) {
  std::vector<PriorShare> shares(aligned.alignments.size());
  for (std::size_t k = 0; k < aligned.places.size(); ++k) shares[aligned.places[k]] = comparison.priors[k];
  comparison.priors = std::move(shares);
  for (PriorPoint& point : comparison.prior_points) point.prior = aligned.places[point.prior];
  comparison.warnings.insert(comparison.warnings.begin(), aligned.warnings.begin(), aligned.warnings.end());
}

}  // namespace raywatch
