#include "tests/evaluate/causes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/evaluate/plates.hpp"
#include "tests/evaluate/score_case.hpp"
#include "tests/evaluate/surroundings.hpp"

using namespace raywatch;
using namespace raywatch::evaluation;
using simulator::radians;

namespace {

const std::vector<Case> kOnePair{{Against::same_pose, 1, {0}}};

/// The errors of a comparison that calls the points changed which `called` picks.
template <class Called>
std::vector<PointError> errors_when(const Place& place, Called called) {
  const IndexedPlace indexed(place, Profile::indoor);
  const CaseLabels labels = labels_of(indexed, kOnePair[0]);
  Verdicts verdicts;
  for (std::size_t i = 0; i < place.scans[1].labels.size(); ++i) verdicts.scan.push_back(called(place.scans[1], i));
  verdicts.priors = {std::vector<std::uint8_t>(place.scans[0].labels.size(), 0)};
  return find_errors(indexed.views(kOnePair[0], Grouping::union_), labels, verdicts);
}

std::vector<PointError> errors_when_all_is_missed(const Place& place) {
  return errors_when(place, [](const SimulatedScan&, std::size_t) { return std::uint8_t{0}; });
}

bool all_have(const std::vector<PointError>& errors, Cause cause) {
  return !errors.empty() && std::ranges::all_of(errors, [&](const PointError& e) { return e.cause == cause; });
}

}  // namespace

TEST_CASE("a missed point that stands clear before a wall has no special cause") {
  const Place place{.name = "", .scans = {scan_of({}, 0), scan_of({{5.0, 1.0, kCame}}, 1)}, .states = {}};
  const std::vector<PointError> errors = errors_when_all_is_missed(place);
  CHECK(errors.size() == 11 * 11);  // half a metre at 5 m is 5.7 degrees
  CHECK(all_have(errors, Cause::other));
  CHECK(std::ranges::all_of(errors, [](const PointError& error) { return error.missed && error.of_scan; }));
}

TEST_CASE("an object of few returns is missed for being faint") {
  const Place place{.name = "", .scans = {scan_of({}, 0), scan_of({{5.0, 0.4, kCame}}, 1)}, .states = {}};
  CHECK(all_have(errors_when_all_is_missed(place), Cause::faint));
}

TEST_CASE("what came behind something that the prior saw is missed as unseen") {
  const Place place{.name = "", .scans = {scan_of({{3.0, 2.0}}, 0), scan_of({{5.0, 1.0, kCame}}, 1)}, .states = {}};
  CHECK(all_have(errors_when_all_is_missed(place), Cause::unseen));
}

TEST_CASE("points within ten centimetres of what stays are missed at the foot") {
  const Place place{.name = "", .scans = {scan_of({}, 0, 0.25), scan_of({{9.93, 1.0, kCame}}, 1, 0.25)}, .states = {}};
  std::size_t at_foot = 0;
  for (const PointError& error : errors_when_all_is_missed(place)) {
    const Eigen::Vector3f point_m = place.scans[1].points[error.index];
    const double to_edge_m = 0.5 - std::max(std::abs(point_m.y()), std::abs(point_m.z()));
    // The wall is 7 cm behind the plate, so that its nearest returns are within 7.1 cm beside the edge.
    if (error.cause == Cause::foot) {
      ++at_foot;
      CHECK(to_edge_m < 0.0715);
    } else {
      CHECK(error.cause == Cause::other);
      CHECK(to_edge_m > 0.0);
    }
  }
  CHECK(at_foot > 20);
}

TEST_CASE("false points between what the prior saw before and behind them lie on its silhouette") {
  const Place place{.name = "", .scans = {scan_of({{3.0, 1.0}}, 0), scan_of({{6.0, 4.0}}, 1)}, .states = {}};
  const auto on_plate = [](const SimulatedScan& scan, std::size_t i) {
    return static_cast<std::uint8_t>(std::abs(scan.points.x_m[i] - 6.0F) < 0.1F);
  };
  for (const PointError& error : errors_when(place, on_plate)) {
    const Eigen::Vector3d towards = place.scans[1].points[error.index].cast<double>().normalized();
    const Eigen::Vector3d on_prior_m = 3.0 / towards.x() * towards;
    const double off_edge_m = std::max(std::abs(on_prior_m.y()), std::abs(on_prior_m.z())) - 0.5;
    // T_a is 1.5 degrees: 8 cm at 3 m; a shot to either side of the edge must lie within it.
    CHECK_FALSE(error.missed);
    if (std::abs(off_edge_m) < 0.02) CHECK(error.cause == Cause::silhouette);
    if (std::abs(off_edge_m) > 0.12) CHECK(error.cause == Cause::other);
  }
}

TEST_CASE("the incidence on a wall is the angle of the ray against the wall's normal") {
  const Place place{.name = "", .scans = {scan_of({}, 0, 0.5), scan_of({}, 1, 0.5)}, .states = {}};
  const IndexedPlace indexed(place, Profile::indoor);
  const ScanView view = indexed.views(kOnePair[0], Grouping::union_).scan;
  for (const double azimuth_deg : {0.0, 30.0, 60.0, 80.0}) {
    const double angle_rad = radians(azimuth_deg);
    const Surroundings seen = surroundings_of(view, {10.0, 10.0 * std::tan(angle_rad), 0.0}, 0.5);
    CHECK(seen.flat);
    CHECK(seen.incidence_rad == doctest::Approx(angle_rad).epsilon(1e-3).scale(1.0));
  }
}

TEST_CASE("the table of causes has a row for each cause, with shares of all errors") {
  CauseTable table;
  table.add({{.of_scan = true, .missed = true, .cause = Cause::foot},
             {.of_scan = true, .missed = false, .cause = Cause::grazing},
             {.of_scan = false, .missed = true, .cause = Cause::foot},
             {.of_scan = false, .missed = true, .cause = Cause::foot}});
  std::ostringstream out;
  table.write_markdown(out);
  CHECK(out.str().find("| foot | 0 | 1 | 0 | 2 | 75.0 % |") != std::string::npos);
  CHECK(out.str().find("| grazing | 1 | 0 | 0 | 0 | 25.0 % |") != std::string::npos);
  CHECK(out.str().find("| unseen | 0 | 0 | 0 | 0 | 0.0 % |") != std::string::npos);
  CHECK(table.count(Cause::foot, false, true) == 2);
}
