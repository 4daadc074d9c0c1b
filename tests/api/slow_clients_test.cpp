#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "server/machine.hpp"
#include "storage/events.hpp"
#include "storage/store.hpp"
#include "tests/api/api_fixture.hpp"
#include "tests/api/event_listener.hpp"
#include "tests/api/raw_client.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

// What the system buffers for a connection on loopback is some megabytes; much more than that is waiting here.
constexpr int kEvents = 8000;
constexpr std::size_t kText_bytes = 4000;
constexpr std::size_t kStreams = 4;  ///< that a server with 8 threads allows
constexpr std::chrono::milliseconds kStall{500};

void fill_with_events(const std::filesystem::path& data_dir) {
  Store store({.data_dir = data_dir});
  store.write([](Transaction& transaction) {
    for (int i = 0; i < kEvents; ++i) {
      insert_event(transaction, {.at = wall_time(0), .type = "test", .text = std::string(kText_bytes, 'x')});
    }
  });
}

DaemonConfig impatient(const TempDir& folder) {
  DaemonConfig config;
  config.data_dir = folder / "data";
  config.http.port = 0;
  config.http.threads = 2 * kStreams;
  config.http.stall_timeout = kStall;
  config.workers = 1;
  config.compare_threads = 1;
  return config;
}

/// One that asks for everything and takes nothing.
struct SleepyClient : RawClient {
  explicit SleepyClient(std::uint16_t port) : RawClient(port) {
    send("GET /api/v1/events?after=0 HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
};

/// The id of the last event that came as a whole.
int last_whole_id(const std::string& received) {
  const std::size_t end = received.rfind("\n\n");
  const std::size_t id = received.rfind("id: ", received.rfind("\ndata: ", end));
  return std::stoi(received.substr(id + 4));
}

/// The places of clients that went away become free a moment later.
std::unique_ptr<EventListener> listener_when_free(std::uint16_t port, int last_id) {
  for (int attempt = 0; attempt < 30; ++attempt) {
    httplib::Client http("127.0.0.1", port);
    if (http.Head("/api/v1/events")->status == 200) {
      return std::make_unique<EventListener>(port, "", std::to_string(last_id));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  throw std::runtime_error("no place becomes free");
}

TEST_CASE("clients that take nothing are cut off, hold nobody up and cost little; coming back they miss nothing") {
  const TempDir folder;
  fill_with_events(folder / "data");
  Daemon daemon(impatient(folder), fixture_now);
  httplib::Client http("127.0.0.1", daemon.port());
  const std::uint64_t memory_before = resident_memory_bytes();

  std::vector<std::unique_ptr<SleepyClient>> sleepy;
  for (std::size_t i = 0; i + 1 < kStreams; ++i) sleepy.push_back(std::make_unique<SleepyClient>(daemon.port()));
  EventListener lively(daemon.port(), "?after=" + std::to_string(kEvents - 1));
  CHECK_EQ(lively.take(1)[0]["id"], kEvents);

  // While they sleep others read, write and hear of it.
  REQUIRE_EQ(http.Post("/api/v1/sites", R"({"name": "yard"})", "application/json")->status, 201);
  REQUIRE_EQ(http.Post("/api/v1/sensors", R"({"name": "gate", "site": "yard"})", "application/json")->status, 201);
  const std::string upload = "/api/v1/scans?sensor=gate&captured_at=" + format_rfc3339(wall_time(0));
  REQUIRE_EQ(http.Post(upload.c_str(), pcd_of(wall_points({}), wall_pose()), "application/octet-stream")->status, 201);
  CHECK_EQ(lively.take(1)[0]["type"], "scan.stored");

  // Their places become free without their doing.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  std::vector<std::unique_ptr<RawClient>> successors;
  while (successors.size() < sleepy.size() && std::chrono::steady_clock::now() < deadline) {
    auto successor = std::make_unique<RawClient>(daemon.port());
    successor->send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n");
    if (status_of(successor->receive_until("\r\n\r\n")) == 200) successors.push_back(std::move(successor));
  }
  CHECK_EQ(successors.size(), sleepy.size());
  successors.clear();
  constexpr std::uint64_t kBacklog_bytes = (kStreams - 1) * kEvents * kText_bytes;
  CHECK_LT(resident_memory_bytes(), memory_before + kBacklog_bytes / 2);

  const int had = last_whole_id(sleepy.front()->receive_all());
  REQUIRE_LT(had, kEvents);
  const json missed = listener_when_free(daemon.port(), had)->take(static_cast<std::size_t>(kEvents - had) + 1);
  for (std::size_t i = 0; i < missed.size(); ++i) CHECK_EQ(missed[i]["id"], had + 1 + static_cast<int>(i));
}

}  // namespace
}  // namespace raywatch::testing
