#include "core/sample_changes.hpp"

namespace raywatch {

std::vector<std::vector<Eigen::Vector3f>> sample_changes(const ScanView& scan, std::span<const ScanView> priors,
                                                         const Comparison& comparison, std::size_t most) {
  const std::size_t count = comparison.changes.size();
  std::vector<std::size_t> met(count, 0);
  std::vector<std::vector<Eigen::Vector3f>> samples(count);
  // Of n points, those are taken at which the wanted number, spread over n, steps up.
  const auto offer = [&](std::int32_t change, const ScanView& view, std::size_t index) {
    if (change < 0) return;
    const auto place = static_cast<std::size_t>(change);
    const std::size_t points = comparison.changes[place].points;
    const std::size_t k = met[place]++;
    if (points > most && (k + 1) * most / points == k * most / points) return;
    samples[place].push_back((view.world_from_sensor * view.points[index].cast<double>()).cast<float>());
  };
  for (std::size_t i = 0; i < comparison.change_of.size(); ++i) offer(comparison.change_of[i], scan, i);
  for (const PriorPoint& point : comparison.prior_points) offer(point.change, priors[point.prior], point.index);
  return samples;
}

}  // namespace raywatch
