#include "core/align_sample.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/plane_patch.hpp"
#include "core/prior_index_impl.hpp"

namespace raywatch {
namespace {

/// So many directions are looked at for each piece that is wanted.
constexpr std::size_t kCandidatesPerPiece = 2;
/// The normals are told apart by the face of a cube that they point through, and by the cell of it.
constexpr int kCellsPerEdge = 3;
constexpr std::size_t kNormalClasses = 6 * kCellsPerEdge * kCellsPerEdge;

std::size_t normal_class(const Eigen::Vector3d& normal) {
  Eigen::Index axis = 0;
  const double greatest = normal.cwiseAbs().maxCoeff(&axis);
  const auto cell = [&](Eigen::Index of) {
    const double across = 0.5 * (normal[of % 3] / greatest + 1.0) * kCellsPerEdge;
    return std::clamp(static_cast<int>(across), 0, kCellsPerEdge - 1);
  };
  const int face = 2 * static_cast<int>(axis) + (normal[axis] < 0.0);
  return static_cast<std::size_t>((face * kCellsPerEdge + cell(axis + 1)) * kCellsPerEdge + cell(axis + 2));
}

/// Returns from evenly spread directions: one from each of so many runs of occupied cells of the index.
std::vector<std::uint32_t> spread_returns(const PriorIndex::Impl& index, std::size_t count) {
  std::vector<std::uint32_t> occupied;
  for (std::uint32_t cell = 0; cell + 1 < index.first.size(); ++cell) {
    if (index.first[cell] < index.first[cell + 1]) occupied.push_back(cell);
  }
  const std::size_t taken = std::min(count, occupied.size());
  std::vector<std::uint32_t> spread(taken);
  for (std::size_t k = 0; k < taken; ++k) spread[k] = standing_for(index, occupied[k * occupied.size() / taken]);
  return spread;
}

std::vector<SurfaceSample> pieces_at(const ScanView& scan, const std::vector<std::uint32_t>& returns) {
  const PriorIndex::Impl& index = scan.index.impl();
  const PatchFitter fitter(scan);
  std::vector<std::optional<SurfaceSample>> found(returns.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, returns.size(), 64), [&](const auto& block) {
    for (std::size_t k = block.begin(); k < block.end(); ++k) {
      const std::uint32_t i = returns[k];
      const Eigen::Vector3d point_m = point_of(index.returns[i]);
      const std::optional<PlanePatch> patch = fitter(point_m);
      if (patch) found[k] = {patch->along_ray(point_m), patch->normal(), patch->sigma_m};
    }
  });
  std::vector<SurfaceSample> pieces;
  for (const std::optional<SurfaceSample>& piece : found) {
    if (piece) pieces.push_back(*piece);
  }
  return pieces;
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const ScanView& scan, std::size_t count) {
  const std::vector<SurfaceSample> pieces =
      pieces_at(scan, spread_returns(scan.index.impl(), kCandidatesPerPiece * count));
  if (pieces.size() <= count) return pieces;
  std::array<std::vector<std::size_t>, kNormalClasses> classes;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    classes[normal_class(scan.world_from_sensor.orientation * pieces[i].normal)].push_back(i);
  }
  // The rarest classes come first and are taken whole, so that what they leave goes to the others in equal shares.
  std::ranges::stable_sort(classes, {}, [](const auto& members) { return members.size(); });
  std::vector<SurfaceSample> chosen;
  for (std::size_t c = 0; c < kNormalClasses; ++c) {
    const std::vector<std::size_t>& members = classes[c];
    const std::size_t share = std::min(members.size(), (count - chosen.size()) / (kNormalClasses - c));
    for (std::size_t k = 0; k < share; ++k) chosen.push_back(pieces[members[k * members.size() / share]]);
  }
  return chosen;
}

}  // namespace raywatch
