#include "tests/simulator/family.hpp"

#include <string>

#include "core/error.hpp"
#include "tests/simulator/story.hpp"

namespace raywatch::simulator {

std::string_view to_string(Family family) {
  switch (family) {
    case Family::sim:
      return "sim";
    case Family::lab:
      return "lab";
    case Family::carpark:
      return "carpark";
    case Family::yard:
      return "yard";
    case Family::mine:
      return "mine";
    case Family::pit:
      return "pit";
    case Family::stream:
      return "stream";
  }
  return {};
}

Family parse_family(std::string_view name) {
  std::string known;
  for (const Family family : kFamilies) {
    if (to_string(family) == name) return family;
    known += (known.empty() ? "" : ", ") + std::string(to_string(family));
  }
  throw InvalidInput("unknown family \"" + std::string(name) + "\"; known are " + known);
}

Timeline make_timeline(Family family, const FamilyOptions& options) {
  switch (family) {
    case Family::sim:
      return sim_timeline(options);
    case Family::lab:
      return lab_timeline(options);
    case Family::carpark:
      return carpark_timeline(options);
    case Family::yard:
      return yard_timeline(options, {});
    case Family::mine:
      return mine_timeline(options);
    case Family::pit:
      return pit_timeline(options);
    case Family::stream:
      return yard_timeline(options, {.sensors = 1, .quiet_rounds = 4, .rounds = 16});
  }
  return {};
}

std::vector<SimulatedScan> simulate(Family family, const FamilyOptions& options) {
  const Timeline timeline = make_timeline(family, options);
  std::vector<SimulatedScan> scans;
  for (const Moment& moment : timeline.moments) scans.push_back(take_scan(timeline, moment));
  return scans;
}

}  // namespace raywatch::simulator
