#include "tests/simulator/timeline.hpp"

#include <algorithm>
#include <stdexcept>

namespace raywatch::simulator {
namespace {

constexpr int kLatticeSteps = 40;

/// The volume of the union of shapes, by the lattice points inside it.
double union_volume_m3(const std::vector<Shape>& shapes, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d step_m = box.sizes() / kLatticeSteps;
  int inside = 0;
  for (int i = 0; i < kLatticeSteps; ++i) {
    for (int j = 0; j < kLatticeSteps; ++j) {
      for (int k = 0; k < kLatticeSteps; ++k) {
        const Eigen::Vector3d place_m =
            box.min() + step_m.cwiseProduct(Eigen::Vector3d(i, j, k) + Eigen::Vector3d::Constant(0.5));
        inside += std::ranges::any_of(shapes, [&](const Shape& shape) { return encloses(shape, place_m); }) ? 1 : 0;
      }
    }
  }
  return step_m.prod() * inside;
}

}  // namespace

StateId add_object(Timeline& timeline, const NewObject& object) {
  if (timeline.objects.size() + 1 >= kNoSurface) throw std::length_error("more object states than there are labels");
  ObjectState state;
  state.id = static_cast<StateId>(timeline.objects.size() + 1);
  state.name = object.name;
  state.kind = object.kind;
  state.shapes = object.shapes;
  for (const Shape& shape : object.shapes) state.box.extend(bounds(shape).value());
  state.volume_m3 =
      object.shapes.size() == 1 ? volume_m3(object.shapes.front()) : union_volume_m3(object.shapes, state.box);
  timeline.objects.push_back(std::move(state));
  return timeline.objects.back().id;
}

Scene lasting_scene(const Timeline& timeline, const std::vector<StateId>& present) {
  Scene scene;
  scene.add(timeline.background);
  for (const StateId id : present) scene.add(timeline.object(id).shapes, id);
  scene.present.insert(present.begin(), present.end());
  return scene;
}

Scene scene_at(const Timeline& timeline, const Moment& moment) {
  Scene scene = lasting_scene(timeline, moment.present);
  scene.add(moment.passing);
  for (std::size_t i = 0; i < timeline.trees.size(); ++i) {
    const Tree& tree = timeline.trees[i];
    const std::uint64_t wind_seed = moment.wind_seed == 0 ? 0 : scrambled(moment.wind_seed + i);
    scene.add(placed(trunk(tree.size), tree.stand));
    scene.add(placed(leaves(tree.size, wind_seed), tree.stand));
  }
  return scene;
}

SimulatedScan take_scan(const Timeline& timeline, const Moment& moment) {
  const Scene scene = scene_at(timeline, moment);
  return take_scan(RayCaster(scene), timeline.scanners.at(moment.scanner), moment.plan);
}

}  // namespace raywatch::simulator
