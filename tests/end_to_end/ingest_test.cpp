#include <doctest/doctest.h>

#include <fstream>

#include "tests/end_to_end/api_client.hpp"
#include "tests/end_to_end/daemon_process.hpp"
#include "tests/end_to_end/process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;

TEST_CASE("a folder of scans is uploaded in the order of capture, and repeating it changes nothing") {
  const raywatch::TempDir folder;
  const std::filesystem::path scans = folder.path() / "scans";
  std::filesystem::create_directory(scans);
  scan_place({}, 0).write(scans, "z_first");
  scan_place({.box = true}, 1).write(scans, "a_second");
  DaemonProcess daemon(folder.path() / "data");
  const std::vector<std::string> ingest = {"ingest", scans.string(), "--server", daemon.url(), "--sensor",
                                           "gate",   "--site",       "yard",     "--create"};
  const Ended first = run_raywatch(ingest);
  CHECK_MESSAGE(first.exit_code == 0, first.err);
  CHECK(first.out == "2 stored, 0 already there, 0 failed\n");
  CHECK(first.err.find("z_first") < first.err.find("a_second"));

  ApiClient api(daemon.url());
  CHECK(api.wait_for_all_scans().size() == 2);
  CHECK(api.get("/api/v1/changes?site=yard").json()["items"].size() == 1);

  const Ended second = run_raywatch(ingest);
  CHECK(second.exit_code == 0);
  CHECK(second.out == "0 stored, 2 already there, 0 failed\n");
  CHECK(api.wait_for_all_scans().size() == 2);
}

TEST_CASE("a file that is refused does not stop the others, and the exit code tells") {
  const raywatch::TempDir folder;
  const std::filesystem::path good = scan_place({}, 0).write(folder.path(), "good");
  const std::filesystem::path broken = folder.path() / "broken.pcd";
  std::ofstream(broken) << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n";
  DaemonProcess daemon(folder.path() / "data");
  const Ended ended = run_raywatch({"ingest", broken.string(), good.string(), "--server", daemon.url(), "--sensor",
                                    "gate", "--site", "yard", "--create"});
  CHECK(ended.exit_code == 1);
  CHECK(ended.out == "1 stored, 0 already there, 1 failed\n");
  CHECK(ended.err.find("broken.pcd: failed: ") != std::string::npos);
}

TEST_CASE("while the server is busy a file is sent again until it is taken") {
  const raywatch::TempDir folder;
  const std::filesystem::path scans = folder.path() / "scans";
  std::filesystem::create_directory(scans);
  for (int i = 0; i < 6; ++i) scan_place({.box = i % 2 == 1}, i).write(scans, std::to_string(i));
  const std::filesystem::path config = folder.path() / "raywatch.toml";
  std::ofstream(config) << "[ingest]\nqueue_limit = 1\n";
  DaemonProcess daemon(folder.path() / "data", {"--config", config.string()});
  const Ended ended = run_raywatch(
      {"ingest", scans.string(), "--server", daemon.url(), "--sensor", "gate", "--site", "yard", "--create"});
  CHECK_MESSAGE(ended.exit_code == 0, ended.err);
  CHECK(ended.out == "6 stored, 0 already there, 0 failed\n");
}

TEST_CASE("a sensor that does not exist is only made when asked for") {
  const raywatch::TempDir folder;
  const std::filesystem::path scan = scan_place({}, 0).write(folder.path(), "scan");
  DaemonProcess daemon(folder.path() / "data");
  const Ended ended = run_raywatch({"ingest", scan.string(), "--server", daemon.url(), "--sensor", "gate"});
  CHECK(ended.exit_code == 1);
  CHECK(ended.err.find("--create") != std::string::npos);
}

TEST_CASE("a server that is not there is said to be so") {
  const raywatch::TempDir folder;
  const std::filesystem::path scan = scan_place({}, 0).write(folder.path(), "scan");
  const Ended ended = run_raywatch({"ingest", scan.string(), "--server", "http://127.0.0.1:1", "--sensor", "gate"});
  CHECK(ended.exit_code == 1);
  CHECK(ended.err.find("http://127.0.0.1:1") != std::string::npos);
  CHECK(run_raywatch({"ingest", scan.string(), "--server", "nonsense", "--sensor", "gate"}).exit_code == 2);
}
