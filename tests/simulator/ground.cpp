#include "tests/simulator/ground.hpp"

#include <cmath>

#include "tests/simulator/random.hpp"

namespace raywatch::simulator {

double lattice_noise(const Eigen::Vector2d& place, std::uint64_t seed) {
  const Eigen::Vector2d corner = place.array().floor();
  const CounterRandom random(seed);
  const auto value = [&](int column, int row) {
    const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(corner.x()) + column);
    const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(corner.y()) + row);
    return 2.0 * random.uniform(Purpose::scene, scrambled(x) + y) - 1.0;
  };
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double u = smooth(place.x() - corner.x());
  const double v = smooth(place.y() - corner.y());
  return std::lerp(std::lerp(value(0, 0), value(1, 0), u), std::lerp(value(0, 1), value(1, 1), u), v);
}

std::shared_ptr<const HeightField> bumpy_ground(const BumpyGround& ground) {
  constexpr double kCell_m = 0.5;
  const auto nodes = static_cast<std::uint32_t>(std::ceil(2.0 * ground.half_size_m / kCell_m)) + 1;
  const FieldLayout layout{Eigen::Vector2d::Constant(-ground.half_size_m), kCell_m, nodes, nodes};
  return std::make_shared<HeightField>(layout, [&](const Eigen::Vector2d& place_m) {
    return ground.bump_height_m *
           (0.7 * lattice_noise(place_m / 4.0, ground.seed) + 0.3 * lattice_noise(place_m, ground.seed + 1));
  });
}

}  // namespace raywatch::simulator
