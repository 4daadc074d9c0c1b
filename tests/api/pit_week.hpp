#pragma once

#include <set>
#include <string>
#include <vector>

#include "tests/api/api_fixture.hpp"
#include "tests/simulator/timeline.hpp"

namespace raywatch::testing {

/// The site "pit" in the time zone of Perth, with the zone "bench", and the scans of a simulated week, each night's at
/// 02:00 and 02:20 UTC from 2026-02-22 on, coarser than real ones. The clock of the fixture stands after it.
class PitWeek : public ApiFixture {
 public:
  PitWeek();

  /// Uploads the scans of a night and waits until they are compared.
  void upload_night(std::uint32_t night);
  /// A schedule at 05:00 UTC of every day, from before the week on. @returns it.
  nlohmann::json add_schedule(const nlohmann::json& survey, const nlohmann::json& more = nlohmann::json::object());
  /// Waits until no run of a schedule is queued or running. @returns them, oldest first.
  nlohmann::json finished_runs(const nlohmann::json& schedule);
  /// The same of one run.
  nlohmann::json finished(nlohmann::json run);

  nlohmann::json items(const std::string& target);
  nlohmann::json zone() const { return zone_; }
  const simulator::TrueGround& ground() const { return timeline_.ground; }

 private:
  simulator::Timeline timeline_;
  nlohmann::json zone_;
};

}  // namespace raywatch::testing
