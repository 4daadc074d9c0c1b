#include <algorithm>

#include "tests/simulator/floor_plan.hpp"
#include "tests/simulator/ground.hpp"
#include "tests/simulator/story.hpp"

namespace raywatch::simulator {
namespace {

/// The fenced ground reaches from -half to +half.
const Eigen::Vector2d kHalfYard_m(20.0, 14.0);

std::vector<Lookout> lookouts(RandomSequence& random, std::size_t sensors) {
  std::vector<Lookout> result;
  for (const double side : {-1.0, 1.0}) {
    if (result.size() == sensors) break;
    const Eigen::Vector2d corner_m = side * (kHalfYard_m - Eigen::Vector2d(5.0, 3.0));
    const double yaw_rad = std::atan2(-corner_m.y(), -corner_m.x()) + random.in({-0.2, 0.2});
    const Eigen::Vector3d mast_m(corner_m.x(), corner_m.y(), random.in({3.5, 4.5}));
    result.push_back({.sensor = "yard-" + std::to_string(result.size() + 1),
                      .nominal_world_from_sensor = Viewpoint{mast_m, yaw_rad, radians(6.0)}.pose(),
                      .mount = Mount::fixed});
  }
  return result;
}

Stand standing(const Eigen::Vector2d& place_m, double yaw_rad) { return {{place_m.x(), place_m.y(), 0.0}, yaw_rad}; }

void fence_in(Timeline& timeline) {
  const double x = kHalfYard_m.x();
  const double y = kHalfYard_m.y();
  const double quarter = 0.5 * std::numbers::pi;
  append(timeline, placed(fence({.length_m = 2.0 * x}), standing({-x, -y}, 0.0)));
  append(timeline, placed(fence({.length_m = 2.0 * x}), standing({-x, y}, 0.0)));
  append(timeline, placed(fence({.length_m = 2.0 * y}), standing({-x, -y}, quarter)));
  append(timeline, placed(fence({.length_m = 2.0 * y}), standing({x, -y}, quarter)));
}

FloorPlan furnish(Timeline& timeline, RandomSequence& random, const std::vector<Lookout>& views, bool hard) {
  timeline.background = {
      Terrain{bumpy_ground({.half_size_m = 60.0, .bump_height_m = 0.04, .seed = random.seed()}), nullptr}};
  fence_in(timeline);
  append(timeline, placed(box({12.0, 6.0, 5.0}), standing({random.in({-6.0, 6.0}), 24.0}, 0.0)));  // a hall
  plant(timeline, random, {{-20.0, 17.0}, {20.0, 17.0}, hard ? 6 : 3});
  plant(timeline, random, {{-20.0, -17.0}, {20.0, -17.0}, hard ? 6 : 3});

  FloorPlan floor({-kHalfYard_m + Eigen::Vector2d::Ones(), kHalfYard_m - Eigen::Vector2d::Ones()});
  for (const Lookout& view : views) {
    const Eigen::Vector2d mast_m = view.nominal_world_from_sensor.position_m.head<2>();
    floor.keep_free(mast_m, 4.0);
  }
  const auto scatter = [&](int count, double room_m, const auto& make) {
    for (int i = 0; i < count; ++i) {
      const auto place_m = floor.take(random, room_m);
      if (place_m) append(timeline, placed(make(), standing(*place_m, random.in({0.0, 2.0 * std::numbers::pi}))));
    }
  };
  scatter(hard ? 3 : 2, 3.3, [] { return box({6.06, 2.44, 2.59}); });
  scatter(hard ? 12 : 5, 0.8, [&] { return box({1.2, 0.8, random.in({0.15, 1.4})}); });
  scatter(hard ? 8 : 4, 0.4, [] { return pillar({0.29, 0.88}); });
  scatter(hard ? 6 : 2, 0.3, [&] { return pillar({random.in({0.03, 0.08}), 5.0}); });
  return floor;
}

/// What comes and goes in the yard. Every state has a place that no other one ever has.
struct Yard {
  Timeline& timeline;
  RandomSequence& random;
  const std::vector<Lookout>& views;
  FloorPlan& floor;
  std::vector<StateId> crates = {};
  std::vector<StateId> bags = {};
  int crates_made = 0;
  int bags_made = 0;
  int persons_made = 0;

  std::vector<StateId> present() const {
    std::vector<StateId> ids = crates;
    ids.insert(ids.end(), bags.begin(), bags.end());
    return ids;
  }

  bool is_seen(StateId id) const {
    std::vector<StateId> everything = present();
    everything.push_back(id);
    return std::ranges::any_of(
        views, [&](const Lookout& view) { return returns_from(timeline, view, everything, id) >= kSeen; });
  }

  /// Puts a thing where a sensor sees it. Nothing when no such place is found: then the yard is full.
  std::optional<StateId> put(const NewObject& thing, double room_m) {
    constexpr int kTrials = 100;
    for (int trial = 0; trial < kTrials; ++trial) {
      const auto place_m = floor.find(random, room_m);
      if (!place_m) return std::nullopt;
      const Stand stand = standing(*place_m, random.in({0.0, 2.0 * std::numbers::pi}));
      const StateId id = add_object(timeline, {thing.name, thing.kind, placed(thing.shapes, stand)});
      if (is_seen(id)) {
        floor.keep_free(*place_m, room_m);
        return id;
      }
      timeline.objects.pop_back();
    }
    return std::nullopt;
  }

  void put_crate() {
    const double length_m = random.in({0.6, 1.1});
    const Shapes shapes = box({length_m, random.in({0.5, 0.8}), random.in({0.5, 0.9})});
    if (const auto id = put({"crate " + std::to_string(++crates_made), "crate", shapes}, 0.75)) crates.push_back(*id);
  }
  void leave_bag() {
    const double length_m = random.in({0.45, 0.6});
    const Shapes shapes = box({length_m, random.in({0.25, 0.35}), random.in({0.3, 0.45})});
    if (const auto id = put({"bag " + std::to_string(++bags_made), "bag", shapes}, 0.4)) bags.push_back(*id);
  }
  void remove_one(std::vector<StateId>& from) {
    if (!from.empty()) from.erase(from.begin() + static_cast<std::ptrdiff_t>(random.below(from.size())));
  }
  /// Where a person walks next: the same one as long as `goes_on`.
  std::optional<StateId> person_steps(bool goes_on) {
    if (!goes_on) ++persons_made;
    return put({"person " + std::to_string(persons_made), "person", person(random)}, 0.35);
  }
};

/// What happens in one round. Returns who is only passing.
std::optional<StateId> next_event(Yard& yard, std::uint32_t since_quiet) {
  switch (since_quiet) {
    case 0:
      yard.leave_bag();
      return std::nullopt;
    case 2:
      yard.remove_one(yard.crates);
      return std::nullopt;
    case 3:
      return yard.person_steps(false);
    case 4:
    case 5:
      return yard.person_steps(true);
    case 7:
      yard.remove_one(yard.bags);
      return std::nullopt;
    case 8:
      yard.put_crate();
      return std::nullopt;
    case 1:
    case 6:
    case 9:
      return std::nullopt;
    default:
      break;
  }
  switch (yard.random.below(8)) {
    case 0:
      yard.leave_bag();
      return std::nullopt;
    case 1:
      yard.remove_one(yard.bags);
      return std::nullopt;
    case 2:
      yard.remove_one(yard.crates);
      return std::nullopt;
    case 3:
      yard.put_crate();
      return std::nullopt;
    case 4:
      return yard.person_steps(false);
    default:
      return std::nullopt;
  }
}

/// The same when little happens. Returns who is only passing; `passes` says whether somebody did in the round before.
std::optional<StateId> rare_event(Yard& yard, std::uint32_t since_quiet, std::uint32_t apart, bool passes) {
  if (since_quiet % apart != 0) {
    return yard.random.below(3) == 0 ? yard.person_steps(passes && yard.random.below(2) == 0) : std::nullopt;
  }
  switch (since_quiet / apart % 4) {
    case 0:
      yard.leave_bag();
      break;
    case 1:
      yard.remove_one(yard.crates);
      break;
    case 2:
      yard.remove_one(yard.bags);
      break;
    default:
      yard.put_crate();
  }
  return std::nullopt;
}

}  // namespace

Timeline yard_timeline(const FamilyOptions& options, const YardStory& story) {
  RandomSequence random(options.seed);
  Timeline timeline;
  timeline.scanners = {usual_scanner(options)};
  const std::vector<Lookout> views = lookouts(random, story.sensors);
  FloorPlan floor = furnish(timeline, random, views, options.hard);
  Yard yard{timeline, random, views, floor};
  for (int i = 0; i < 4; ++i) yard.put_crate();

  const auto sensors = static_cast<std::uint32_t>(views.size());
  const std::uint32_t scans = options.scans.value_or(story.rounds * sensors);
  std::optional<StateId> passer;
  const auto passing_in = [&](std::uint32_t round) -> std::optional<StateId> {
    if (round < story.quiet_rounds) return std::nullopt;
    const std::uint32_t since_quiet = round - story.quiet_rounds;
    if (story.rounds_apart == 0) return next_event(yard, since_quiet);
    return rare_event(yard, since_quiet, story.rounds_apart, passer.has_value());
  };
  for (std::uint32_t i = 0; i < scans; ++i) {
    const std::uint32_t round = i / sensors;
    const std::uint32_t sensor = i % sensors;
    if (sensor == 0) passer = passing_in(round);
    std::vector<StateId> present = yard.present();
    if (passer) present.push_back(*passer);
    const Duration since_start =
        options.interval.value_or(std::chrono::seconds(30)) * round + std::chrono::seconds(1) * sensor;
    append_scan(timeline, options,
                {.lookout = views[sensor],
                 .captured_at = start_of(options) + since_start,
                 .present = std::move(present),
                 .windy = true});
  }
  timeline.scanners = {ring_scanner(options)};
  timeline.scanners.front().errors.self_return_share = 0.0;
  return timeline;
}

}  // namespace raywatch::simulator
