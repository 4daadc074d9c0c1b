#include <doctest/doctest.h>
#include <sched.h>
#include <sys/mount.h>

#include <chrono>
#include <fstream>
#include <set>
#include <string>
#include <thread>

#include "tests/end_to_end/api_client.hpp"
#include "tests/end_to_end/daemon_process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

/// A small file system of its own, which only this process and its children see; nothing where that is not allowed.
class SmallDisk {
 public:
  SmallDisk(const fs::path& where, const std::string& size) : where_(where) {
    fs::create_directories(where_);
    is_there_ = ::unshare(CLONE_NEWNS) == 0 && ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                ::mount("tmpfs", where_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (is_there_) ::umount2(where_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_there() const { return is_there_; }

  /// Something else takes the room until so much is left.
  void fill_up_to(std::uintmax_t free_bytes) const {
    std::ofstream other(where_ / "other", std::ios::binary | std::ios::app);
    const std::string piece(4096, 'x');
    while (fs::space(where_).available > free_bytes && other << piece << std::flush) {
    }
  }
  void make_room() const { fs::remove(where_ / "other"); }

 private:
  fs::path where_;
  bool is_there_ = false;
};

/// A daemon whose store lies on a disk of its own, with nothing kept free unless it is said.
struct DaemonOnSmallDisk {
  raywatch::TempDir directory;
  SmallDisk disk{directory.path() / "disk", "24m"};
  fs::path config = directory.path() / "raywatch.toml";
  int number = 0;

  explicit DaemonOnSmallDisk(int reserve_mib) {
    std::ofstream(config) << "[storage]\nmin_free_disk_mib = " << reserve_mib << "\n";
  }
  DaemonProcess daemon() const { return DaemonProcess(directory.path() / "disk/data", {"--config", config.string()}); }
  PlaceScan next() { return scan_place({}, number++); }
};

bool is_allowed(const DaemonOnSmallDisk& place) {
  if (!place.disk.is_there()) MESSAGE("SKIPPED: a file system of its own needs the right to mount one");
  return place.disk.is_there();
}

/// Uploads while the daemon is asked to come back.
template <class Done>
ApiReply upload_until(ApiClient& api, const PlaceScan& scan, const Done& done) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  ApiReply reply = api.upload(scan);
  while (!done(reply) && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    reply = api.upload(scan);
  }
  return reply;
}

bool is_refused(const ApiReply& reply) { return reply.status == 507; }
bool is_stored(const ApiReply& reply) { return reply.status == 201 || reply.status == 200; }

}  // namespace

TEST_CASE("below the reserve scans are refused and everything else goes on; with room again all goes on by itself") {
  DaemonOnSmallDisk place(8);
  if (!is_allowed(place)) return;
  const DaemonProcess daemon = place.daemon();
  ApiClient api(daemon.url());
  api.make_site_and_sensor();
  REQUIRE(api.upload(place.next(), std::chrono::seconds(20)).status == 201);
  place.disk.fill_up_to(7u << 20);

  const PlaceScan refused = place.next();
  const ApiReply reply = api.upload(refused);
  CHECK(reply.status == 507);
  CHECK(reply.json()["type"] == "urn:raywatch:problem:disk-full");
  CHECK(reply.json()["detail"].get<std::string>().find("8 MiB are kept free") != std::string::npos);
  CHECK(api.get("/readyz").status == 503);
  CHECK(api.get("/api/v1/scans").json()["items"].size() == 1);
  CHECK(api.get("/api/v1/scans/1/points?format=pcd").status == 200);
  CHECK(api.get("/api/v1/storage").status == 200);

  place.disk.make_room();
  CHECK(upload_until(api, refused, is_stored).status == 201);
  CHECK(api.wait_for_all_scans().size() == 2);
  CHECK(api.get("/readyz").status == 200);
}

TEST_CASE("a disk that is full in the middle of a write loses nothing that was answered with 201") {
  DaemonOnSmallDisk place(0);
  if (!is_allowed(place)) return;
  std::set<std::string> answered;
  {
    DaemonProcess daemon = place.daemon();
    ApiClient api(daemon.url());
    api.make_site_and_sensor();
    place.disk.fill_up_to(3u << 20);
    ApiReply reply;
    PlaceScan scan = place.next();
    for (int i = 0; i < 500 && !is_refused(reply); ++i) {
      reply = api.upload(scan);
      if (!is_stored(reply)) continue;
      answered.insert(scan.time_text());
      scan = place.next();
    }
    REQUIRE(reply.status == 507);
    REQUIRE(answered.size() >= 1);
    CHECK(api.get("/api/v1/scans?limit=1000").json()["items"].size() == answered.size());
    place.disk.make_room();
    CHECK(upload_until(api, scan, is_stored).status == 201);
    answered.insert(scan.time_text());
    daemon.kill();
  }
  const DaemonProcess daemon = place.daemon();
  ApiClient api(daemon.url());
  std::set<std::string> stored;
  for (const json& scan : api.wait_for_all_scans()) {
    CHECK(scan["state"] == "compared");
    CHECK(api.get("/api/v1/scans/" + scan["id"].dump() + "/points?format=pcd").status == 200);
    stored.insert(scan["captured_at"]);
  }
  CHECK(stored == answered);
  CHECK(daemon.log().find("damaged") == std::string::npos);
}
