#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "tests/end_to_end/api_client.hpp"
#include "tests/end_to_end/daemon_process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;
using nlohmann::json;

namespace {

/// Uploads scans until the daemon is gone.
class Uploader {
 public:
  Uploader(const std::string& url, int first) : thread_([this, url, first] { upload(url, first); }) {}

  /// Waits until so many were answered with 201.
  void wait_for(int count) const {
    for (int now = count_; now < count; now = count_) count_.wait(now);
  }

  /// The numbers of the scans that were answered with 201, once the daemon is gone.
  std::set<int> stored() {
    thread_.join();
    return stored_;
  }

 private:
  void upload(const std::string& url, int number) {
    ApiClient api(url);
    for (;; ++number) {
      const ApiReply reply = api.upload(scan_place({.box = number % 3 == 1}, number));
      if (reply.status == 0) break;
      CHECK(reply.status == 201);
      stored_.insert(number);
      ++count_;
      count_.notify_all();
    }
    count_ = std::numeric_limits<int>::max();  // nobody waits for a daemon that is gone
    count_.notify_all();
  }

  std::set<int> stored_;
  std::atomic<int> count_{0};
  std::jthread thread_;  // last: it uses the others
};

}  // namespace

TEST_CASE("after kill -9 at any moment every scan that was answered with 201 is there, compared exactly once") {
  const raywatch::TempDir folder;
  {  // An orderly life first, so that the killed ones begin with a site.
    DaemonProcess daemon(folder.path() / "data");
    ApiClient(daemon.url()).make_site_and_sensor();
    REQUIRE(daemon.stop() == 0);
  }
  std::mt19937 random(20260301);
  std::uniform_int_distribution<int> scans_before(1, 5);
  std::uniform_int_distribution<int> moment_us(0, 60'000);
  std::set<int> answered;
  for (int round = 0; round < 6; ++round) {
    DaemonProcess daemon(folder.path() / "data");
    Uploader uploader(daemon.url(), 1000 * round);
    uploader.wait_for(scans_before(random));
    // The moment of the crash is what this test varies; nothing waits for it.
    std::this_thread::sleep_for(std::chrono::microseconds(moment_us(random)));
    daemon.kill();
    answered.merge(uploader.stored());
  }
  REQUIRE(answered.size() >= 6);

  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  const json scans = api.wait_for_all_scans();
  std::map<std::string, json> by_time;
  for (const json& scan : scans) by_time[scan["captured_at"]] = scan;
  CHECK(by_time.size() == scans.size());
  for (const int number : answered) {
    const PlaceScan sent = scan_place({.box = number % 3 == 1}, number);
    REQUIRE(by_time.contains(sent.time_text()));
    const json& scan = by_time[sent.time_text()];
    CHECK(api.get("/api/v1/scans/" + scan["id"].dump() + "/points?frame=sensor&format=pcd")
              .body.ends_with(sent.pcd().substr(sent.pcd().find("DATA binary"))));
  }
  // Those that were stored but whose answer was lost are whole as well.
  for (const json& scan : scans) {
    CHECK(scan["state"] == "compared");
    REQUIRE(scan["comparisons"].size() == 2);
    const json comparison = api.get("/api/v1/comparisons/" + scan["comparison"].dump()).json();
    CHECK(comparison["state"] == "done");
    const json changes =
        api.get("/api/v1/comparisons/" + scan["comparison"].dump() + "/changes?limit=1000").json()["items"];
    CHECK(changes.size() == comparison["changes"]);
  }
  CHECK(daemon.stop() == 0);
}
