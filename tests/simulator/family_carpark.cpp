#include <algorithm>
#include <stdexcept>

#include "tests/simulator/ground.hpp"
#include "tests/simulator/story.hpp"

namespace raywatch::simulator {
namespace {

constexpr std::size_t kPoses = 3;
constexpr double kBayWidth_m = 2.6;
constexpr int kBaysPerRow = 10;
/// Two rows back to back, the aisle in which the scanning vehicle drives (around y = 0), and a row beyond it.
constexpr double kRows_m[] = {-7.0, 7.0, 12.5};

std::vector<Lookout> lookouts(RandomSequence& random, bool hard) {
  std::vector<Lookout> result;
  for (const double middle_m : {-9.0, 0.0, 9.0}) {
    const double x = middle_m + random.in({-1.5, 1.5});
    const double y = random.in({-1.0, 1.0});
    const double pitch_rad = (hard ? radians(1.5) : radians(0.5)) * random.normal();
    result.push_back({.sensor = "carpark-" + std::to_string(result.size() + 1),
                      .nominal_world_from_sensor =
                          Viewpoint{{x, y, random.in({1.8, 2.0})}, random.in({-0.2, 0.2}), pitch_rad}.pose()});
  }
  return result;
}

void append_surroundings(Timeline& timeline, RandomSequence& random, bool hard) {
  timeline.background = {Terrain{bumpy_ground({.bump_height_m = hard ? 0.05 : 0.02, .seed = random.seed()}), nullptr}};
  append(timeline, placed(box({60.0, 8.0, random.in({6.0, 12.0})}), {{0.0, 22.0, -0.1}, 0.0}));
  append(timeline, placed(box({60.0, 0.15, 0.12}), {{0.0, -10.0, 0.0}, 0.0}));  // a kerb
  append(timeline, placed(fence({.length_m = 40.0}), {{-20.0, -14.0, 0.0}, 0.0}));
  for (int i = 0; i < (hard ? 8 : 4); ++i) {
    const double x = -15.0 + 30.0 * i / (hard ? 7 : 3);
    append(timeline, placed(pillar({0.08, 7.0}), {{x, 9.75, 0.0}, 0.0}));
    append(timeline, placed(box({0.4, 0.4, random.in({0.5, 1.1})}), {{x + 1.3, -10.6, 0.0}, random.in({0.0, 1.0})}));
  }
}

/// The bays, each of which belongs to one car for the whole story: a car that comes where another one has left would be
/// a change of state that no scan can show.
class Bays {
 public:
  explicit Bays(RandomSequence& random) {
    for (const double y : kRows_m) {
      for (int i = 0; i < kBaysPerRow; ++i) empty_.push_back({kBayWidth_m * (i - 0.5 * (kBaysPerRow - 1)), y});
    }
    for (std::size_t i = empty_.size(); i > 1; --i) std::swap(empty_[i - 1], empty_[random.below(i)]);
  }
  bool any() const { return !empty_.empty(); }

  /// Parks a car, slightly askew, in a bay that was never used.
  StateId park(Timeline& timeline, RandomSequence& random, const std::string& name, const Shapes& shapes) {
    const Eigen::Vector2d middle_m = empty_.back();
    empty_.pop_back();
    const double forwards = random.chance(0.5) ? 0.5 : -0.5;
    const double x = middle_m.x() + random.in({-0.15, 0.15});
    const double y = middle_m.y() + random.in({-0.2, 0.2});
    const Stand stand{{x, y, 0.0}, forwards * std::numbers::pi + random.in({-0.04, 0.04})};
    return add_object(timeline, {name, "car", placed(shapes, stand)});
  }

 private:
  std::vector<Eigen::Vector2d> empty_;
};

/// A car is told from others by its name; moved, it keeps its shapes.
struct Cars {
  Timeline& timeline;
  RandomSequence& random;
  Bays bays{random};
  std::vector<Shapes> models = {};
  std::vector<std::pair<std::size_t, StateId>> parked = {};

  void arrive() {
    models.push_back(car(random));
    const std::size_t model = models.size() - 1;
    parked.emplace_back(model, park(model));
  }
  StateId park(std::size_t model) {
    return bays.park(timeline, random, "car " + std::to_string(model + 1), models[model]);
  }
  std::vector<StateId> present() const {
    std::vector<StateId> ids;
    for (const auto& [model, id] : parked) ids.push_back(id);
    return ids;
  }
  /// A random parked car that some lookout sees well.
  std::size_t visible(const std::vector<Lookout>& views) {
    for (int trial = 0; trial < 1000; ++trial) {
      const std::size_t chosen = random.below(parked.size());
      const auto sees = [&](const Lookout& view) {
        return returns_from(timeline, view, present(), parked[chosen].second) >= 3 * kSeen;
      };
      if (std::ranges::any_of(views, sees)) return chosen;
    }
    throw std::runtime_error("no car of the car park is seen well; another seed may have one");
  }
  void leave(std::size_t car) { parked.erase(parked.begin() + static_cast<std::ptrdiff_t>(car)); }
};

/// The first three events are a car that moves, one that leaves and one that arrives; later ones are random. When every
/// bay has been used, nothing more happens.
void next_event(Cars& cars, const std::vector<Lookout>& views, std::uint32_t epoch) {
  const std::uint64_t event = epoch <= 3 ? epoch - 1 : cars.random.below(3);
  if (event == 1 && cars.parked.size() > 4) return cars.leave(cars.visible(views));
  if (!cars.bays.any()) return;
  if (event == 2) return cars.arrive();
  const std::size_t moving = cars.visible(views);
  cars.parked[moving].second = cars.park(cars.parked[moving].first);
}

}  // namespace

Timeline carpark_timeline(const FamilyOptions& options) {
  RandomSequence random(options.seed);
  Timeline timeline;
  timeline.scanners = {usual_scanner(options)};
  const std::vector<Lookout> views = lookouts(random, options.hard);
  append_surroundings(timeline, random, options.hard);
  plant(timeline, random, {{-18.0, -17.0}, {18.0, -17.0}, options.hard ? 7 : 3});
  Cars cars{timeline, random};
  const std::size_t first_cars = options.hard ? 20 : 14;
  while (cars.parked.size() < first_cars) cars.arrive();

  const std::uint32_t scans = options.scans.value_or(4 * kPoses);
  for (std::uint32_t i = 0; i < scans; ++i) {
    const auto epoch = static_cast<std::uint32_t>(i / kPoses);
    if (epoch > 0 && i % kPoses == 0) next_event(cars, views, epoch);
    const Duration since_start =
        std::chrono::minutes(30) * epoch + options.interval.value_or(std::chrono::minutes(1)) * (i % kPoses);
    append_scan(timeline, options,
                {.lookout = views[i % kPoses],
                 .captured_at = start_of(options) + since_start,
                 .present = cars.present(),
                 .windy = options.hard});
  }
  timeline.scanners = {ring_scanner(options)};
  return timeline;
}

}  // namespace raywatch::simulator
