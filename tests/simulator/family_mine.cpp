#include "tests/simulator/floor_plan.hpp"
#include "tests/simulator/pit.hpp"
#include "tests/simulator/story.hpp"

namespace raywatch::simulator {
namespace {

constexpr std::uint32_t kStations = 2;
constexpr double kTripod_m = 1.8;

Scanner survey_scanner(const FamilyOptions& options) {
  Scanner scanner = tripod_scanner({.azimuth_steps = steps_at_density(2400, options.density),
                                    .elevation_steps = steps_at_density(600, options.density),
                                    .lowest_elevation_rad = radians(-40.0),
                                    .highest_elevation_rad = radians(50.0)});
  scanner.max_range_m = 600.0;
  scanner.no_return = NoReturn::nan;
  scanner.errors = {.range_noise_m = 0.008,
                    .angular_noise_rad = 5e-5,
                    .beam_divergence_rad = 3e-4,
                    .blend_length_m = 0.8,
                    .dropout_share = 0.005};
  return scanner;
}

Stand on_ground(const HeightField& ground, const Eigen::Vector2d& place_m, double yaw_rad) {
  return {{place_m.x(), place_m.y(), ground.height_m(place_m)}, yaw_rad};
}

std::vector<Lookout> stations(RandomSequence& random, const HeightField& ground) {
  std::vector<Lookout> result;
  for (const double y_m : {-38.0, 38.0}) {
    const double x = random.in({-62.0, -45.0});
    const Stand stand = on_ground(ground, {x, y_m + random.in({-6.0, 6.0})}, random.in({0.0, 2.0 * std::numbers::pi}));
    const Eigen::Vector3d head_m = stand.foot_m + Eigen::Vector3d(0.0, 0.0, kTripod_m);
    result.push_back({.sensor = "mine-" + std::to_string(result.size() + 1),
                      .nominal_world_from_sensor = Viewpoint{head_m, stand.yaw_rad}.pose()});
  }
  return result;
}

std::string names_of(std::uint64_t nights) {
  std::string text;
  for (int night = 0; night < 64; ++night) {
    if ((nights >> night & 1) != 0) text += (text.empty() ? "" : ",") + std::to_string(night);
  }
  return text;
}

/// What the ground of each night is, and which of its states are there.
struct Nights {
  std::vector<std::shared_ptr<const HeightField>> ground;
  std::vector<Terrain> terrain = {};
  std::vector<std::vector<StateId>> present = {};
};

Nights dig(Timeline& timeline, const Pit& pit, std::uint32_t count) {
  Nights nights;
  for (std::uint32_t i = 0; i < count; ++i) nights.ground.push_back(std::make_shared<HeightField>(pit.ground(i)));
  const auto first_id = static_cast<StateId>(timeline.objects.size() + 1);
  const GroundTruth truth = compare_nights(nights.ground, first_id);
  nights.present.resize(count);
  for (const GroundState& state : truth.states) {
    const auto id = static_cast<StateId>(timeline.objects.size() + 1);
    timeline.objects.push_back({.id = id,
                                .name = "ground of nights " + names_of(state.nights),
                                .kind = "rock",
                                .shapes = {},
                                .box = state.box,
                                .volume_m3 = state.volume_m3});
    for (std::uint32_t i = 0; i < count; ++i) {
      if ((state.nights >> i & 1) != 0) nights.present[i].push_back(id);
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) nights.terrain.push_back({nights.ground[i], truth.cells[i]});
  return nights;
}

void add_earthworks(Timeline& timeline, const Nights& nights) {
  for (std::size_t i = 1; i < nights.ground.size(); ++i) {
    timeline.earthworks.push_back(volume_change(*nights.ground[i - 1], *nights.ground[i]));
  }
}

/// One scan a station and night, in turn.
void append_scans(Timeline& timeline, const FamilyOptions& options, const std::vector<Lookout>& views,
                  const Nights& nights, std::uint32_t scans) {
  for (std::uint32_t i = 0; i < scans; ++i) {
    const std::uint32_t night = i / kStations;
    const Duration since_start =
        std::chrono::hours(24) * night + options.interval.value_or(std::chrono::minutes(20)) * (i % kStations);
    append_scan(timeline, options,
                {.lookout = views[i % kStations],
                 .captured_at = start_of(options) + since_start,
                 .present = nights.present[night],
                 .passing = {nights.terrain[night]}});
  }
}

/// Trucks stand at another place every night.
void park_trucks(Timeline& timeline, RandomSequence& random, FloorPlan& floor, Nights& nights, int trucks) {
  for (std::size_t night = 0; night < nights.ground.size(); ++night) {
    for (int i = 0; i < trucks; ++i) {
      const auto place_m = floor.take(random, 5.5);
      if (!place_m) return;
      const Stand stand = on_ground(*nights.ground[night], *place_m, random.in({0.0, 2.0 * std::numbers::pi}));
      nights.present[night].push_back(
          add_object(timeline, {"truck " + std::to_string(i + 1), "truck", placed(truck(), stand)}));
    }
  }
}

// The pit from the wall opposite.

constexpr std::uint32_t kNights = 7;
constexpr double kStation_m = 24.0;  ///< height above the pit's floor
const Eigen::AlignedBox2d kArea_m(Eigen::Vector2d(-26.0, -80.0), Eigen::Vector2d(30.0, 80.0));
constexpr double kCell_m = 2.0;

Scanner light_scanner(const FamilyOptions& options) {
  Scanner scanner;
  const std::uint32_t columns = steps_at_density(320, options.density), rows = steps_at_density(300, options.density);
  for (std::uint32_t i = 0; i < columns; ++i) scanner.azimuths_rad.push_back(radians(-75.0 + 150.0 * i / columns));
  for (std::uint32_t i = 0; i < rows; ++i) scanner.elevations_rad.push_back(radians(-42.0 + 45.0 * i / rows));
  scanner.max_range_m = 600.0;
  scanner.errors.range_noise_m = 0.02;
  return scanner;
}

std::vector<Lookout> lookouts(RandomSequence& random) {
  std::vector<Lookout> views;
  for (const double y_m : {-45.0, 45.0}) {
    const Eigen::Vector3d at_m(random.in({-75.0, -60.0}), y_m + random.in({-15.0, 15.0}), kStation_m);
    views.push_back(
        {.sensor = "pit-" + std::to_string(views.size() + 1), .nominal_world_from_sensor = {.position_m = at_m}});
  }
  return views;
}

std::vector<double> mean_heights_m(const HeightField& ground, const TrueGround& grid) {
  std::vector<double> heights_m;
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d low_m = grid.corner_m + grid.cell_m * Eigen::Vector2d(column, row);
      const Eigen::Vector2d high_m = low_m + Eigen::Vector2d::Constant(grid.cell_m);
      heights_m.push_back(mean_height_m(ground, {low_m, high_m}));
    }
  }
  return heights_m;
}

}  // namespace

Timeline mine_timeline(const FamilyOptions& options) {
  RandomSequence random(options.seed);
  Timeline timeline;
  timeline.scanners = {survey_scanner(options)};
  const std::uint32_t scans = options.scans.value_or(2 * kStations);
  Nights nights = dig(timeline, Pit(random.seed()), (scans + kStations - 1) / kStations);
  add_earthworks(timeline, nights);

  const HeightField& first = *nights.ground.front();
  const std::vector<Lookout> views = stations(random, first);
  const Eigen::Vector2d low_m(Pit::kFloorFrom_m, -Pit::kHalfWidth_m);
  FloorPlan floor(Eigen::AlignedBox2d(low_m, Eigen::Vector2d(Pit::kFloorTo_m, Pit::kHalfWidth_m)));
  for (const Lookout& view : views) floor.keep_free(view.nominal_world_from_sensor.position_m.head<2>(), 6.0);
  for (int i = 0; i < (options.hard ? 12 : 4); ++i) {
    const auto place_m = floor.take(random, 1.5);
    if (!place_m) break;
    const Shapes thing = i % 2 == 0 ? pillar({0.1, 8.0}) : box({2.0, 1.2, 1.5});
    append(timeline, placed(thing, on_ground(first, *place_m, random.in({0.0, 1.5}))));
  }
  park_trucks(timeline, random, floor, nights, options.hard ? 3 : 1);

  append_scans(timeline, options, views, nights, scans);
  return timeline;
}

Timeline pit_timeline(const FamilyOptions& options) {
  RandomSequence random(options.seed);
  Timeline timeline;
  timeline.scanners = {light_scanner(options)};
  timeline.ground = {.corner_m = kArea_m.min(),
                     .cell_m = kCell_m,
                     .columns = static_cast<std::uint32_t>(kArea_m.sizes().x() / kCell_m),
                     .rows = static_cast<std::uint32_t>(kArea_m.sizes().y() / kCell_m),
                     .mean_height_m = {}};
  const std::uint32_t scans = options.scans.value_or(kNights * kStations);
  const Nights nights = dig(timeline, Pit(random.seed()), (scans + kStations - 1) / kStations);
  for (const auto& ground : nights.ground) {
    timeline.ground.mean_height_m.push_back(mean_heights_m(*ground, timeline.ground));
  }
  add_earthworks(timeline, nights);
  const std::vector<Lookout> views = lookouts(random);
  append_scans(timeline, options, views, nights, scans);
  return timeline;
}

}  // namespace raywatch::simulator
