#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

#include "tests/end_to_end/api_client.hpp"
#include "tests/end_to_end/daemon_process.hpp"
#include "tests/end_to_end/process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;
using nlohmann::json;

namespace {

constexpr std::chrono::seconds kLong{60};

/// The changes of a scan that was uploaded and compared.
json changes_of(ApiClient& api, const ApiReply& uploaded) {
  const json scan = uploaded.json();
  REQUIRE(scan["state"] == "compared");
  const std::string comparison = "/api/v1/comparisons/" + scan["comparison"].dump();
  REQUIRE(api.get(comparison).json()["state"] == "done");
  return api.get(comparison + "/changes").json()["items"];
}

/// That there is one change, and that it is the box.
void check_is_box(const json& changes, const char* kind) {
  REQUIRE(changes.size() == 1);
  const json& change = changes[0];
  CHECK(change["kind"] == kind);
  CHECK(change["points"] == kBoxPoints);
  // The box of the change encloses 13 x 13 returns of a flat side, with 2 mm of noise.
  CHECK(change["centroid_m"][0] == doctest::Approx(kBoxFaceCenter_m.x()).epsilon(0.002));
  CHECK(change["centroid_m"][1].get<double>() == doctest::Approx(kBoxFaceCenter_m.y()).epsilon(0.01));
  CHECK(change["centroid_m"][2].get<double>() == doctest::Approx(kBoxFaceCenter_m.z()).epsilon(0.01));
}

std::filesystem::path write_config(const std::filesystem::path& folder, const std::string& toml) {
  std::filesystem::path file = folder / "raywatch.toml";
  std::ofstream(file) << toml;
  return file;
}

}  // namespace

TEST_CASE("a person with two scans of one place sees over HTTP what was added, and with a third what was removed") {
  const raywatch::TempDir folder;
  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  api.make_site_and_sensor();

  const ApiReply empty = api.upload(scan_place({}, 0), kLong);
  CHECK(empty.status == 201);
  CHECK(changes_of(api, empty).empty());

  const ApiReply with_box = api.upload(scan_place({.box = true}, 1), kLong);
  CHECK(with_box.status == 201);
  check_is_box(changes_of(api, with_box), "added");

  const ApiReply empty_again = api.upload(scan_place({}, 2), kLong);
  check_is_box(changes_of(api, empty_again), "removed");
  CHECK(daemon.stop() == 0);
}

TEST_CASE("what was stored is there after a restart") {
  const raywatch::TempDir folder;
  json before;
  {
    DaemonProcess daemon(folder.path() / "data");
    ApiClient api(daemon.url());
    api.make_site_and_sensor();
    api.upload(scan_place({}, 0), kLong);
    api.upload(scan_place({.box = true}, 1), kLong);
    before = api.get("/api/v1/changes?site=yard").json();
    CHECK(daemon.stop() == 0);
  }
  DaemonProcess daemon(folder.path() / "data");
  CHECK(ApiClient(daemon.url()).get("/api/v1/changes?site=yard").json() == before);
  CHECK(before["items"].size() == 1);
}

TEST_CASE("the same bytes again are no second scan, and other bytes of that time are refused") {
  const raywatch::TempDir folder;
  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  api.make_site_and_sensor();
  const PlaceScan scan = scan_place({}, 0);
  const ApiReply first = api.upload(scan, kLong);
  CHECK(first.status == 201);
  const ApiReply second = api.upload(scan, kLong);
  CHECK(second.status == 200);
  CHECK(second.json()["id"] == first.json()["id"]);

  PlaceScan other = scan_place({.box = true}, 0);
  CHECK(api.upload(other).status == 409);
  CHECK(api.wait_for_all_scans().size() == 1);
}

TEST_CASE("scans that arrive late are compared with what was before them") {
  const raywatch::TempDir folder;
  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  api.make_site_and_sensor();
  api.upload(scan_place({}, 0), kLong);
  api.upload(scan_place({.box = true}, 2), kLong);
  const ApiReply late = api.upload(scan_place({}, 1), kLong);
  CHECK(changes_of(api, late).empty());  // the box came later
}

TEST_CASE("a capture time in the future is refused") {
  const raywatch::TempDir folder;
  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  api.make_site_and_sensor();
  PlaceScan scan = scan_place({}, 0);
  scan.captured_at = std::chrono::system_clock::now() + std::chrono::hours(1);
  const ApiReply refused = api.upload(scan);
  CHECK(refused.status == 422);
  CHECK(refused.json()["errors"][0]["field"] == "captured_at");
  CHECK(api.wait_for_all_scans().empty());
}

TEST_CASE("the daemon stops cleanly within five seconds of SIGTERM, with work in the queue") {
  const raywatch::TempDir folder;
  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  api.make_site_and_sensor();
  for (int i = 0; i < 12; ++i) REQUIRE(api.upload(scan_place({.box = i % 2 == 1}, i)).status == 201);
  const auto asked = std::chrono::steady_clock::now();
  CHECK(daemon.stop() == 0);
  CHECK(std::chrono::steady_clock::now() - asked < std::chrono::seconds(5));

  DaemonProcess again(folder.path() / "data");
  const json scans = ApiClient(again.url()).wait_for_all_scans();
  CHECK(scans.size() == 12);
  for (const json& scan : scans) CHECK(scan["state"] == "compared");
}

TEST_CASE("a second daemon on the same data is refused, and the first one serves on") {
  const raywatch::TempDir folder;
  DaemonProcess daemon(folder.path() / "data");
  const Ended second =
      run_raywatch({"serve", "--data-dir", (folder.path() / "data").string(), "--listen", "127.0.0.1:0"});
  CHECK(second.exit_code == 1);
  CHECK(second.err.find("raywatch: ") != std::string::npos);
  CHECK(ApiClient(daemon.url()).get("/readyz").status == 200);
}

TEST_CASE("another address than loopback needs a flag") {
  const raywatch::TempDir folder;
  const Ended refused =
      run_raywatch({"serve", "--data-dir", (folder.path() / "data").string(), "--listen", "0.0.0.0:0"});
  CHECK(refused.exit_code == 2);
  CHECK(refused.err.find("--listen: \"0.0.0.0\" is not a loopback address") != std::string::npos);
  CHECK(refused.err.find("--allow-remote, or allow_remote = true") != std::string::npos);
}

TEST_CASE("when the queue is full, uploads are asked to come back, and nothing is lost") {
  const raywatch::TempDir folder;
  const std::filesystem::path config = write_config(folder.path(), "[ingest]\nqueue_limit = 1\n");
  DaemonProcess daemon(folder.path() / "data", {"--config", config.string()});
  ApiClient(daemon.url()).make_site_and_sensor();

  // All at once: what commits first fills the queue, and all that wait for the writer behind it find it full.
  std::vector<ApiReply> replies(8);
  {
    std::vector<std::jthread> clients;
    for (int i = 0; i < 8; ++i) {
      clients.emplace_back([&, i] { replies[i] = ApiClient(daemon.url()).upload(scan_place({.box = i % 2 == 1}, i)); });
    }
  }
  std::size_t stored = 0, refused = 0;
  for (const ApiReply& reply : replies) {
    stored += reply.status == 201;
    refused += reply.status == 503;
    if (reply.status == 503) CHECK(std::stoi(reply.retry_after) >= 1);
  }
  CHECK(stored >= 1);
  CHECK(refused >= 1);
  CHECK(stored + refused == replies.size());
  CHECK(ApiClient(daemon.url()).wait_for_all_scans().size() == stored);
}

TEST_CASE("a backup of a running daemon is a store that another daemon starts on") {
  const raywatch::TempDir folder;
  DaemonProcess daemon(folder.path() / "data");
  ApiClient api(daemon.url());
  api.make_site_and_sensor();
  api.upload(scan_place({}, 0), kLong);
  const json stored = api.upload(scan_place({.box = true}, 1), kLong).json();

  const std::filesystem::path copy = folder.path() / "copy";
  const Ended backup = run_raywatch({"backup", copy.string(), "--server", daemon.url()});
  CHECK_MESSAGE(backup.exit_code == 0, backup.err);

  // Without the daemon the files are copied directly; while it runs, that is refused.
  const std::vector<std::string> direct = {"backup", (folder.path() / "copy-2").string(), "--data-dir",
                                           (folder.path() / "data").string()};
  CHECK(run_raywatch(direct).exit_code == 1);
  const std::string changes = api.get("/api/v1/changes?site=yard").body;
  const std::string points = api.get("/api/v1/scans/" + stored["id"].dump() + "/points?format=pcd").body;
  CHECK(daemon.stop() == 0);
  CHECK(run_raywatch(direct).exit_code == 0);

  for (const char* name : {"copy", "copy-2"}) {
    DaemonProcess restored(folder.path() / name);
    ApiClient other(restored.url());
    CHECK(other.get("/api/v1/changes?site=yard").body == changes);
    CHECK(other.get("/api/v1/scans/" + stored["id"].dump() + "/points?format=pcd").body == points);
  }
}
