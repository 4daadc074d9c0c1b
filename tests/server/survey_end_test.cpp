// How runs of surveys end before they are done: cancelled by an operator, or put back because the program ends.

#include <doctest/doctest.h>

#include <functional>
#include <stop_token>
#include <utility>

#include "tests/server/pit_place.hpp"

namespace raywatch {
namespace {

/// Two nights, and a run that waits. The clock of its runner is read between the steps of a run, and at its start and
/// end: `at_reading` is called with the number of each reading but the first, which is inside of a transaction.
class RunByHand : public PitPlace {
 public:
  RunByHand() {
    take_night(0);
    take_night(1);
    run_ = add_run(0, 1);
  }

  RunRecord carry_out(const std::function<void(int)>& at_reading, const std::stop_token& stop = {}) {
    int reading = 0;
    SurveyRunner runner(store(), cache(), "1.2.3", [&] {
      if (++reading > 1) at_reading(reading);
      return kFirst;
    });
    CHECK(runner.run_next(arena(), stop));
    readings_ = reading;
    return run();
  }
  RunRecord run() {
    return store().read([&](const Snapshot& s) { return find_run(s, run_).value(); });
  }
  bool cancel() {
    return store().write([&](Transaction& t) { return cancel_run(t, run_, "cancelled by anna", kFirst); });
  }
  std::size_t surveys() {
    return store().read([&](const Snapshot& s) { return list_surveys(s, {}, {}).items.size(); });
  }
  int readings() const { return readings_; }
  void next_run() { run_ = add_run(0, 1); }

 private:
  RunId run_;
  int readings_ = 0;
};

TEST_CASE("a run that is cancelled at any step ends without a survey, and the next one goes on") {
  RunByHand place;
  RunRecord ended;
  int step = 2;
  for (;; ++step) {
    ended = place.carry_out([&](int reading) {
      if (reading == step) CHECK(place.cancel());
    });
    if (place.readings() < step) break;
    CAPTURE(step);
    CHECK(ended.state == RunState::cancelled);
    CHECK(ended.why == "cancelled by anna");
    CHECK_FALSE(ended.survey);
    CHECK(place.surveys() == 0);
    CHECK_FALSE(place.cancel());
    place.next_run();
  }
  CHECK(step > 5);
  CHECK(ended.state == RunState::done);
  CHECK(place.surveys() == 1);
  CHECK_FALSE(place.cancel());
}

TEST_CASE("a run that is stopped at any step is put back without counting the attempt, and gives one result at last") {
  RunByHand place;
  RunRecord ended;
  int put_back = 0;
  for (int step = 2;; ++step) {
    std::stop_source stop;
    ended = place.carry_out(
        [&](int reading) {
          if (reading == step) stop.request_stop();
        },
        stop.get_token());
    if (ended.state == RunState::done) break;
    CAPTURE(step);
    CHECK(ended.state == RunState::queued);
    CHECK(ended.attempts == 0);
    CHECK(place.surveys() == 0);
    ++put_back;
  }
  CHECK(put_back >= 3);
  CHECK(ended.attempts == 1);
  CHECK(place.surveys() == 1);
}

TEST_CASE("a run that waits is cancelled at once, and nothing is carried out") {
  RunByHand place;
  CHECK(place.cancel());
  SurveyRunner runner(place.store(), place.cache(), "1.2.3", [] { return kFirst; });
  CHECK_FALSE(runner.run_next(place.arena()));
  CHECK(place.run().state == RunState::cancelled);
}

TEST_CASE("a program that cannot wait for a survey puts it back, and what the survey finds then is left out") {
  RunByHand place;
  bool once = true;
  const RunRecord left = place.carry_out([&](int reading) {
    if (reading > 5 && std::exchange(once, false)) {
      place.store().write([](Transaction& t) { put_back_running_runs(t); });
    }
  });
  CHECK_FALSE(once);
  CHECK(left.state == RunState::queued);
  CHECK(left.attempts == 0);
  CHECK(place.surveys() == 0);
  CHECK(place.carry_out([](int) {}).state == RunState::done);
  CHECK(place.surveys() == 1);
}

}  // namespace
}  // namespace raywatch
