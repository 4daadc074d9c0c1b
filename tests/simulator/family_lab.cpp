#include <algorithm>
#include <stdexcept>

#include "tests/simulator/floor_plan.hpp"
#include "tests/simulator/story.hpp"

namespace raywatch::simulator {
namespace {

const Eigen::Vector3d kRoom_m(14.0, 10.0, 3.2);
const Eigen::Vector3d kBox_m(0.14, 0.17, 0.40);
constexpr double kTableHeight_m = 0.74;
constexpr std::size_t kPoses = 3;
constexpr std::size_t kPlaces = 4;

struct Furnished {
  FloorPlan floor;
  std::vector<Stand> tables;  ///< the middle of each top
};

Stand standing(const Eigen::Vector2d& place_m, double yaw_rad) { return {{place_m.x(), place_m.y(), 0.0}, yaw_rad}; }

std::vector<Lookout> lookouts(RandomSequence& random) {
  std::vector<Lookout> result;
  for (const Eigen::Vector2d& middle_m : {Eigen::Vector2d(-5.0, -2.5), {0.5, 3.2}, {5.0, -2.0}}) {
    const double x = middle_m.x() + random.in({-0.6, 0.6});
    const double y = middle_m.y() + random.in({-0.6, 0.6});
    const double yaw_rad = random.in({-std::numbers::pi, std::numbers::pi});
    result.push_back({.sensor = "lab-" + std::to_string(result.size() + 1),
                      .nominal_world_from_sensor = Viewpoint{{x, y, random.in({1.3, 1.6})}, yaw_rad}.pose()});
  }
  return result;
}

void furnish_walls(Timeline& timeline, RandomSequence& random, FloorPlan& floor, int shelves) {
  for (int i = 0; i < shelves; ++i) {
    const bool left = random.chance(0.5);
    const Eigen::Vector2d place_m(random.in({-6.0, 6.0}), (left ? 1.0 : -1.0) * (0.5 * kRoom_m.y() - 0.22));
    if (!floor.is_free(place_m, 0.6)) continue;
    floor.keep_free(place_m, 0.6);
    append(timeline, placed(shelf({0.4, 1.1, random.in({1.6, 2.2})}),
                            standing(place_m, left ? -0.5 * std::numbers::pi : 0.5 * std::numbers::pi)));
  }
}

/// Tables, some with a screen or a carton on them, which leave the middle of the top free.
void furnish_tables(Timeline& timeline, RandomSequence& random, Furnished& room, int tables) {
  for (int i = 0; i < tables; ++i) {
    const auto place_m = room.floor.take(random, 0.95);
    if (!place_m) return;
    const Stand stand = standing(*place_m, random.in({0.0, std::numbers::pi}));
    append(timeline, placed(table({1.6, 0.8, kTableHeight_m}), stand));
    Stand top = stand;
    top.foot_m.z() = kTableHeight_m;
    room.tables.push_back(top);
    for (const double side : {-0.55, 0.55}) {
      if (!random.chance(0.6)) continue;
      const Eigen::Vector3d size_m =
          random.chance(0.5) ? Eigen::Vector3d(0.5, 0.06, 0.35) : Eigen::Vector3d(0.3, 0.2, 0.25);
      append(timeline, placed(box(size_m), {top.pose() * Eigen::Vector3d(side, 0.0, 0.0), stand.yaw_rad}));
    }
  }
}

void furnish_floor(Timeline& timeline, RandomSequence& random, FloorPlan& floor, int things) {
  for (int i = 0; i < things; ++i) {
    const auto place_m = floor.take(random, 0.4);
    if (!place_m) return;
    const Stand stand = standing(*place_m, random.in({0.0, 2.0 * std::numbers::pi}));
    switch (random.below(4)) {
      case 0:
        append(timeline, placed(potted_plant(random), stand));
        break;
      case 1:
        append(timeline, placed(box({0.4, 0.3, random.in({0.3, 0.9})}), stand));
        break;
      case 2:
        append(timeline, placed(pillar({random.in({0.02, 0.15}), random.in({1.2, kRoom_m.z()})}), stand));
        break;
      default:
        append(timeline, placed(chair(), stand));
        break;
    }
  }
}

Furnished furnish(Timeline& timeline, RandomSequence& random, const std::vector<Lookout>& views, bool hard) {
  const Eigen::Vector2d corner_m = 0.5 * kRoom_m.head<2>() - Eigen::Vector2d::Constant(0.1);
  Furnished room{FloorPlan({-corner_m, corner_m}), {}};
  for (const Lookout& view : views) room.floor.keep_free(view.nominal_world_from_sensor.position_m.head<2>(), 1.2);
  timeline.background = {Room{{Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.5 * kRoom_m.z()}}, 0.5 * kRoom_m}};
  furnish_walls(timeline, random, room.floor, hard ? 8 : 5);
  furnish_tables(timeline, random, room, hard ? 7 : 5);
  furnish_floor(timeline, random, room.floor, hard ? 24 : 11);
  return room;
}

std::optional<Stand> random_stand(RandomSequence& random, const Furnished& room) {
  const double yaw_rad = random.in({0.0, 2.0 * std::numbers::pi});
  if (!room.tables.empty() && random.chance(0.4)) {
    const Stand& table = room.tables[random.below(room.tables.size())];
    const double along_m = random.in({-0.2, 0.2});
    return Stand{table.pose() * Eigen::Vector3d(along_m, random.in({-0.2, 0.2}), 0.0), yaw_rad};
  }
  const auto place_m = room.floor.find(random, 0.2);
  return place_m ? std::optional(standing(*place_m, yaw_rad)) : std::nullopt;
}

/// Puts the box on the floor or on a table, where at least two of the poses see it well and it has never stood before.
StateId place_box(Timeline& timeline, RandomSequence& random, const Furnished& room,
                  const std::vector<Lookout>& views) {
  constexpr int kTrials = 500;
  constexpr double kApart_m = 0.6;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto stand = random_stand(random, room);
    if (!stand) continue;
    const StateId id = add_object(timeline, {"box", "box", placed(box(kBox_m), *stand)});
    const Eigen::Vector3d center_m = timeline.object(id).box.center();
    const bool apart = std::ranges::all_of(timeline.objects, [&](const ObjectState& other) {
      return other.id == id || (other.box.center() - center_m).norm() > kApart_m;
    });
    const auto sees = [&](const Lookout& view) { return returns_from(timeline, view, {id}, id) >= kSeen; };
    if (apart && std::ranges::count_if(views, sees) >= 2) return id;
    timeline.objects.pop_back();
  }
  throw std::runtime_error("no place in the lab is seen by two poses; another seed may have one");
}

}  // namespace

Timeline lab_timeline(const FamilyOptions& options) {
  RandomSequence random(options.seed);
  Timeline timeline;
  timeline.scanners = {usual_scanner(options)};
  const std::vector<Lookout> views = lookouts(random);
  const Furnished room = furnish(timeline, random, views, options.hard);
  std::vector<StateId> places;
  for (std::size_t i = 0; i < kPlaces; ++i) places.push_back(place_box(timeline, random, room, views));
  timeline.scanners = {ring_scanner(options)};

  const std::uint32_t scans = options.scans.value_or(kPoses * kPlaces);
  for (std::uint32_t i = 0; i < scans; ++i) {
    const auto epoch = static_cast<std::uint32_t>(i / kPoses);
    const Duration since_start =
        std::chrono::minutes(10) * epoch + options.interval.value_or(std::chrono::minutes(1)) * (i % kPoses);
    append_scan(timeline, options,
                {.lookout = views[i % kPoses],
                 .captured_at = start_of(options) + since_start,
                 .present = {places[epoch % kPlaces]}});
  }
  return timeline;
}

}  // namespace raywatch::simulator
