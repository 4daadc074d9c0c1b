#include <doctest/doctest.h>

#include <fstream>
#include <future>
#include <vector>

#include "storage/formats/side_car.hpp"
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

TEST_CASE("a daemon that is started a moment later is waited for, and what changed is said when it is asked for") {
  const raywatch::TempDir folder;
  const std::string before = scan_place({}, 0).write(folder.path(), "before").string();
  const std::string after = scan_place({.box = true}, 1).write(folder.path(), "after").string();
  std::string url;
  {
    DaemonProcess first(folder.path() / "data");
    url = first.url();
    CHECK(first.stop() == 0);
  }
  // Its port is free again. The upload is under way before the daemon comes back.
  std::future<Ended> ingest = std::async(std::launch::async, [&] {
    return run_raywatch(
        {"ingest", before, after, "--server", url, "--sensor", "gate", "--site", "yard", "--create", "--wait", "60"});
  });
  DaemonProcess daemon(folder.path() / "data", {}, url.substr(std::string("http://").size()));
  const Ended ended = ingest.get();
  CHECK_MESSAGE(ended.exit_code == 0, ended.err);
  CHECK(ended.out.find("2 stored, 0 already there, 0 failed\n" + before +
                       ", scan 1: no earlier scan to compare it with\n" + after + ", scan 2: 1 added (") == 0);
  CHECK(ended.out.find(" % could be judged)\n") != std::string::npos);

  ApiClient api(url);
  CHECK(api.get("/api/v1/changes?site=yard").json()["items"].size() == 1);
  const Ended again = run_raywatch({"ingest", after, "--server", url, "--sensor", "gate", "--wait", "0"});
  CHECK(again.exit_code == 0);
  CHECK(again.out.find("0 stored, 1 already there, 0 failed\n" + after + ", scan 2: 1 added (") == 0);
}

TEST_CASE("a KITTI file, which nothing but its ending shows, is uploaded as one") {
  const raywatch::TempDir folder;
  const std::filesystem::path scans = folder.path() / "scans";
  std::filesystem::create_directory(scans);
  std::vector<float> records;
  for (int i = 0; i < 100; ++i) records.insert(records.end(), {5.0F, 0.1F * static_cast<float>(i), 1.0F, 0.5F});
  const std::filesystem::path file = scans / "k.bin";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(records.data()), static_cast<std::streamsize>(4 * records.size()));
  raywatch::write_side_car(file, {.pose = raywatch::Pose{}, .captured_at = scan_place({}, 0).captured_at});
  DaemonProcess daemon(folder.path() / "data");
  const std::vector<std::string> where = {"--server", daemon.url(), "--sensor", "gate", "--site", "yard", "--create"};
  const auto ingest = [&](const std::filesystem::path& what) {
    std::vector<std::string> arguments = {"ingest", what.string()};
    arguments.insert(arguments.end(), where.begin(), where.end());
    return run_raywatch(arguments);
  };
  const Ended of_file = ingest(file);
  CHECK_MESSAGE(of_file.exit_code == 0, of_file.err);
  CHECK(of_file.out == "1 stored, 0 already there, 0 failed\n");
  CHECK(ingest(scans).out == "0 stored, 1 already there, 0 failed\n");
  CHECK(ApiClient(daemon.url()).get("/api/v1/scans/1").json()["points"] == 100);
}

TEST_CASE("a file that lacks its time is refused with what to write where") {
  const raywatch::TempDir folder;
  const PlaceScan scan = scan_place({}, 0);
  const std::filesystem::path file = scan.write(folder.path(), "scan");
  raywatch::write_side_car(file, {.pose = scan.world_from_sensor});
  DaemonProcess daemon(folder.path() / "data");
  const Ended ended = run_raywatch(
      {"ingest", file.string(), "--server", daemon.url(), "--sensor", "gate", "--site", "yard", "--create"});
  CHECK(ended.exit_code == 1);
  CHECK(ended.err.find("failed: captured_at: nothing says when the scan was taken") != std::string::npos);
  CHECK(ended.err.find(R"(FILE.json beside the file: {"captured_at": ")") != std::string::npos);
}

TEST_CASE("a server that is not there is said to be so") {
  const raywatch::TempDir folder;
  const std::filesystem::path scan = scan_place({}, 0).write(folder.path(), "scan");
  const Ended ended = run_raywatch(
      {"ingest", scan.string(), "--server", "http://127.0.0.1:1", "--sensor", "gate", "--patience-s", "0"});
  CHECK(ended.exit_code == 1);
  CHECK(ended.err.find("http://127.0.0.1:1: cannot connect; is the daemon running there? --server names another") !=
        std::string::npos);
  const Ended backup = run_raywatch({"backup", (folder.path() / "copy").string(), "--server", "http://127.0.0.1:1"});
  CHECK(backup.exit_code == 1);
  CHECK(backup.err.find("cannot connect; is the daemon running there?") != std::string::npos);
  CHECK(run_raywatch({"ingest", scan.string(), "--server", "nonsense", "--sensor", "gate"}).exit_code == 2);
}
