#include <doctest/doctest.h>

#include <chrono>
#include <fstream>
#include <random>
#include <set>
#include <thread>

#include "tests/end_to_end/api_client.hpp"
#include "tests/end_to_end/daemon_process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

template <class Holds>
bool comes_true(const Holds& holds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// A folder, and the configuration of a daemon that watches it.
struct Inbox {
  raywatch::TempDir directory;
  fs::path folder = directory.path() / "in";
  fs::path config = directory.path() / "raywatch.toml";

  Inbox() {
    fs::create_directory(folder);
    std::ofstream(config) << "[[ingest.folder]]\npath = '" << folder.string()
                          << "'\nsensor = 'gate'\nsite = 'yard'\ncreate = true\npoll_ms = 100\nsettle_ms = 200\n"
                             "patience_s = 1\n";
  }

  DaemonProcess daemon() const { return DaemonProcess(directory.path() / "data", {"--config", config.string()}); }

  /// Writes beside, and renames into place: the side-car first.
  void put(int number) const {
    const std::string name = "scan" + std::to_string(number);
    const fs::path file = scan_place({.box = number % 3 == 1}, number).write(directory.path(), name);
    fs::rename(file.string() + ".json", folder / (name + ".pcd.json"));
    fs::rename(file, folder / (name + ".pcd"));
  }

  std::size_t files_in(const fs::path& place) const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(place)) count += entry.path().extension() == ".pcd" ? 1 : 0;
    return count;
  }
};

}  // namespace

TEST_CASE("files that appear in a watched folder are stored, compared, and moved away") {
  const Inbox inbox;
  const DaemonProcess daemon = inbox.daemon();
  ApiClient api(daemon.url());
  inbox.put(0);
  inbox.put(1);
  std::ofstream(inbox.folder / "broken_2026-03-01T10-00-00Z.pcd") << "# .PCD v0.7\nVERSION 0.7\n";
  CHECK(comes_true([&] { return fs::exists(inbox.folder / "failed/broken_2026-03-01T10-00-00Z.pcd"); }));
  CHECK(fs::exists(inbox.folder / "failed/broken_2026-03-01T10-00-00Z.pcd.reason.txt"));
  CHECK(comes_true([&] { return inbox.files_in(inbox.folder / "done") == 2; }));
  CHECK(api.wait_for_all_scans().size() == 2);
  CHECK(api.get("/api/v1/changes?site=yard").json()["items"].size() == 1);
  CHECK(api.get("/metrics").body.find("\nraywatch_folder_files_stored_total 2\n") != std::string::npos);
  CHECK(api.get("/metrics").body.find("\nraywatch_folder_files_failed_total 1\n") != std::string::npos);
}

TEST_CASE("after kill -9 at any moment every file of a watched folder is stored once, and moved to done") {
  const Inbox inbox;
  constexpr int kRounds = 5, kFilesARound = 4;
  std::mt19937 random(20261122);
  std::uniform_int_distribution<int> moment_ms(0, 400);
  for (int round = 0; round < kRounds; ++round) {
    DaemonProcess daemon = inbox.daemon();
    for (int i = 0; i < kFilesARound; ++i) inbox.put(kFilesARound * round + i);
    // The moment of the crash is what this test varies; nothing waits for it.
    std::this_thread::sleep_for(std::chrono::milliseconds(moment_ms(random)));
    daemon.kill();
  }
  const DaemonProcess daemon = inbox.daemon();
  constexpr std::size_t kAll = kRounds * kFilesARound;
  CHECK(comes_true([&] { return inbox.files_in(inbox.folder) == 0; }));
  CHECK(inbox.files_in(inbox.folder / "done") == kAll);
  CHECK(inbox.files_in(inbox.folder / "failed") == 0);
  ApiClient api(daemon.url());
  const json scans = api.wait_for_all_scans();
  CHECK(scans.size() == kAll);
  std::set<std::string> times;
  for (const json& scan : scans) {
    CHECK(scan["state"] == "compared");
    times.insert(scan["captured_at"]);
  }
  CHECK(times.size() == kAll);
}
