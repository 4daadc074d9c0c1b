#include "server/folder_intake.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "core/error.hpp"
#include "server/ingest_service.hpp"
#include "storage/formats/side_car.hpp"
#include "storage/sensors.hpp"
#include "storage/sites.hpp"
#include "tests/api/wall_scan.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch::testing {
namespace {

namespace fs = std::filesystem;
using Clock = FolderIntake::Clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

std::string wall_pcd() { return pcd_of(wall_points({}), wall_pose()); }
/// Without a pose of its own: an identity VIEWPOINT counts as absent.
std::string pcd_without_pose() { return pcd_of(wall_points({}), {}); }

/// A folder that is looked into by hand, at times that the test makes.
struct Watched {
  TempDir directory;
  fs::path folder = directory / "in";
  Store store{{.data_dir = directory / "data", .readers = 2, .min_free_bytes = 0}};
  Time clock = wall_time(24 * 60);
  IndexCache cache{0};
  IngestService service{
      store, cache, {.queue_limit = 1000, .future_tolerance = seconds(60), .file_limits = {}}, [this] {
        return clock;
      }};
  FolderStatus status;
  FolderConfig config;
  std::unique_ptr<FolderIntake> intake;
  Clock::time_point now{};
  int refusals = 0;  ///< so many uploads are told that the queue is full

  explicit Watched(FolderConfig given = {}) : config(std::move(given)) {
    config.path = folder;
    config.create = true;
    if (config.sensor.empty()) config.sensor = "gate";
    config.site = "yard";
    start();
    look();
  }

  /// As after a restart of the program.
  void start() {
    intake = std::make_unique<FolderIntake>(
        store, config,
        [this](const Upload& upload) {
          if (refusals-- > 0) throw Overloaded("full", seconds(1));
          return service.ingest(upload);
        },
        [this] { return clock; }, status);
  }

  void look(milliseconds later = milliseconds(0)) {
    now += later;
    intake->look(now);
  }
  void settle() {
    look();
    look(config.settle);
  }

  std::vector<ScanRecord> scans() {
    return store.read([](const Snapshot& s) { return list_scans(s, {}, {}); }).items;
  }
  bool is_done(const std::string& name) const { return fs::exists(folder / "done" / name); }
  bool has_failed(const std::string& name) const { return fs::exists(folder / "failed" / name); }
  bool is_waiting(const std::string& name) const { return fs::exists(folder / name); }
  std::string reason(const std::string& name) const { return text_of(folder / "failed" / (name + ".reason.txt")); }
};

TEST_CASE("times in names are read as UTC, and other numbers are none") {
  const Time expected = parse_rfc3339("2026-11-22T10:00:05Z");
  for (const char* name : {"2026-11-22T10-00-05Z.pcd", "gate_2026-11-22T10:00:05Z.pcd", "20261122T100005.las",
                           "2026-11-22_10-00-05.ply", "scan-20261122-100005-left.xyz"}) {
    CAPTURE(name);
    CHECK(time_in_name(name) == expected);
  }
  CHECK(time_in_name("20261122T100005.25Z.pcd") == expected + milliseconds(250));
  for (const char* name : {"scan.pcd", "scan_0001.pcd", "20261122.pcd", "20261122100005.pcd", "2026-13-22T10-00-05.pcd",
                           "120261122T100005.pcd", "20261122T1000051.pcd"}) {
    CAPTURE(name);
    CHECK_FALSE(time_in_name(name));
  }
}

TEST_CASE("a file is taken in when it did not change for the settle time, and moved to done with its side-car") {
  Watched in;
  write(in.folder / "a.pcd", wall_pcd());
  write_side_car(in.folder / "a.pcd", {.captured_at = wall_time(3)});
  in.look();
  in.look(in.config.settle - milliseconds(1));
  CHECK(in.scans().empty());
  in.look(milliseconds(1));
  REQUIRE(in.scans().size() == 1);
  CHECK(in.scans()[0].captured_at == wall_time(3));
  CHECK(in.is_done("a.pcd"));
  CHECK(in.is_done("a.pcd.json"));
  CHECK_FALSE(in.is_waiting("a.pcd"));
  CHECK_FALSE(in.is_waiting("a.pcd.json"));
  CHECK(in.status.stored == 1);
  CHECK(in.status.waiting == 0);
}

TEST_CASE("a file that grows waits from its last change") {
  Watched in;
  const std::string name = "2026-03-01T08-00-00Z.pcd", bytes = wall_pcd();
  write(in.folder / name, bytes.substr(0, 500));
  in.look();
  in.look(in.config.settle / 2);
  write(in.folder / name, bytes);
  in.look();
  in.look(in.config.settle / 2);
  CHECK(in.scans().empty());
  in.look(in.config.settle / 2);
  CHECK(in.scans().size() == 1);
}

TEST_CASE("a file that ends before the end that it promises waits for the rest, and then fails with the reason") {
  Watched in;
  const std::string bytes = wall_pcd();
  for (const char* name : {"2026-03-01T08-00-00Z.pcd", "2026-03-01T09-00-00Z.pcd"}) {
    write(in.folder / name, bytes.substr(0, bytes.size() - 100));
  }
  in.settle();
  CHECK(in.status.waiting == 2);
  write(in.folder / "2026-03-01T08-00-00Z.pcd", bytes);
  in.settle();
  CHECK(in.scans().size() == 1);
  CHECK(in.is_waiting("2026-03-01T09-00-00Z.pcd"));
  in.look(in.config.patience);
  CHECK(in.has_failed("2026-03-01T09-00-00Z.pcd"));
  CHECK(in.reason("2026-03-01T09-00-00Z.pcd").find("truncated") != std::string::npos);
  CHECK(in.status.failed == 1);
}

TEST_CASE("a file that was renamed into place is complete at once, and a hidden one is none") {
  Watched in;
  write(in.folder / ".2026-03-01T08-00-00Z.pcd", wall_pcd());
  in.settle();
  CHECK(in.scans().empty());
  fs::rename(in.folder / ".2026-03-01T08-00-00Z.pcd", in.folder / "2026-03-01T08-00-00Z.pcd");
  in.intake->note_renamed("2026-03-01T08-00-00Z.pcd");
  in.look();
  CHECK(in.scans().size() == 1);
}

TEST_CASE("a file without time or pose waits for its side-car") {
  Watched in;
  write(in.folder / "a.pcd", pcd_without_pose());
  write(in.folder / "b.pcd", pcd_without_pose());
  in.settle();
  CHECK(in.scans().empty());
  in.look(in.config.patience - in.config.settle - seconds(1));
  write_side_car(in.folder / "a.pcd", {.pose = wall_pose(), .captured_at = wall_time(1)});
  in.settle();
  CHECK(in.scans().size() == 1);
  CHECK(in.is_done("a.pcd.json"));
  in.look(seconds(1));
  CHECK(in.has_failed("b.pcd"));
  CHECK(in.reason("b.pcd").find("from where the scan was taken") != std::string::npos);
}

TEST_CASE("the pose of a fixed sensor is enough, and a side-car of the file's own wins over its name") {
  Watched in;
  in.store.write(
      [&](Transaction& t) { edit_sensor(t, find_sensor(t, "gate")->id, {.pose = std::optional(wall_pose())}); });
  write(in.folder / "2026-03-01T08-00-00Z.pcd", pcd_without_pose());
  write_side_car(in.folder / "2026-03-01T08-00-00Z.pcd", {.captured_at = wall_time(5)});
  in.settle();
  REQUIRE(in.scans().size() == 1);
  CHECK(in.scans()[0].captured_at == wall_time(5));
}

TEST_CASE("when a file was written is its time only where that was asked for") {
  for (const TimeFrom from : {TimeFrom::name, TimeFrom::mtime}) {
    Watched in(FolderConfig{.time_from = from, .patience = seconds(0)});
    write(in.folder / "a.pcd", wall_pcd());
    const timespec written{.tv_sec = wall_time(7).time_since_epoch() / seconds(1), .tv_nsec = 0};
    const timespec times[2]{written, written};
    REQUIRE(::utimensat(AT_FDCWD, (in.folder / "a.pcd").c_str(), times, 0) == 0);
    in.settle();
    CHECK(in.scans().size() == (from == TimeFrom::mtime ? 1 : 0));
    CHECK(in.has_failed("a.pcd") == (from == TimeFrom::name));
    if (from == TimeFrom::mtime) CHECK(in.scans()[0].captured_at == wall_time(7));
  }
}

TEST_CASE("the same file twice is stored once, and nothing in done is overwritten") {
  Watched in;
  const std::string name = "2026-03-01T08-00-00Z.pcd";
  write(in.folder / name, wall_pcd());
  in.settle();
  write(in.folder / name, wall_pcd());
  in.settle();
  CHECK(in.scans().size() == 1);
  CHECK(in.status.known == 1);
  CHECK(in.is_done(name));
  CHECK(in.is_done("2026-03-01T08-00-00Z-2.pcd"));
}

TEST_CASE("another file of the same sensor and time fails at once, and says why") {
  Watched in;
  write(in.folder / "2026-03-01T08-00-00Z.pcd", wall_pcd());
  write(in.folder / "b_2026-03-01T08-00-00Z.pcd", pcd_of(wall_points({.box = true}), wall_pose()));
  in.settle();
  CHECK(in.scans().size() == 1);
  CHECK(in.has_failed("b_2026-03-01T08-00-00Z.pcd"));
  CHECK(in.reason("b_2026-03-01T08-00-00Z.pcd").find("other bytes") != std::string::npos);
}

TEST_CASE("links, pipes and folders are left alone") {
  Watched in;
  write(in.directory / "elsewhere.pcd", wall_pcd());
  fs::create_symlink(in.directory / "elsewhere.pcd", in.folder / "2026-03-01T08-00-00Z.pcd");
  REQUIRE(::mkfifo((in.folder / "2026-03-01T09-00-00Z.pcd").c_str(), 0600) == 0);
  fs::create_directory(in.folder / "2026-03-01T10-00-00Z.pcd");
  in.settle();
  in.look(in.config.patience);
  CHECK(in.scans().empty());
  CHECK(in.status.failed == 0);
}

TEST_CASE("files of one look are stored in the order of capture") {
  Watched in;
  write(in.folder / "a_2026-03-01T10-00-00Z.pcd", wall_pcd());
  write(in.folder / "b_2026-03-01T08-00-00Z.pcd", wall_pcd());
  write(in.folder / "c.pcd", wall_pcd());
  write_side_car(in.folder / "c.pcd", {.captured_at = parse_rfc3339("2026-03-01T09:00:00Z")});
  in.settle();
  const std::vector<ScanRecord> newest_first = in.scans();
  REQUIRE(newest_first.size() == 3);
  CHECK(newest_first[0].id > newest_first[1].id);
  CHECK(newest_first[1].id > newest_first[2].id);
}

TEST_CASE("while the queue is full everything waits, and then goes on") {
  Watched in;
  write(in.folder / "2026-03-01T08-00-00Z.pcd", wall_pcd());
  write(in.folder / "2026-03-01T09-00-00Z.pcd", wall_pcd());
  in.refusals = 1;
  in.settle();
  CHECK(in.scans().empty());
  in.look(milliseconds(999));
  CHECK(in.scans().empty());
  in.look(milliseconds(1));
  CHECK(in.scans().size() == 2);
}

TEST_CASE("a side-car that names the sensor serves where the folder does not, and a sensor that is not there is said") {
  Watched in(FolderConfig{.sensor = "gate", .patience = seconds(0)});
  in.config.sensor.clear();
  in.start();
  for (const char* sensor : {"gate", "nobody"}) {
    const fs::path file = in.folder / (std::string(sensor) + "_2026-03-01T08-00-00Z.pcd");
    write(file, wall_pcd());
    write_side_car(file, {.sensor = sensor});
  }
  in.settle();
  CHECK(in.scans().size() == 1);
  CHECK(in.reason("nobody_2026-03-01T08-00-00Z.pcd").find("nobody") != std::string::npos);
}

TEST_CASE("a stop between storing and moving leaves nothing twice, and no side-car for later files") {
  Watched in;
  const std::string name = "2026-03-01T08-00-00Z.pcd";
  write(in.folder / name, wall_pcd());
  write_side_car(in.folder / name, {.captured_at = wall_time(3)});
  in.settle();
  // As if it had stopped before it moved the file, and another time before it moved the side-car.
  fs::rename(in.folder / "done" / name, in.folder / name);
  fs::rename(in.folder / "done" / (name + ".json"), in.folder / (name + ".json"));
  in.start();
  in.settle();
  CHECK(in.scans().size() == 1);
  CHECK(in.is_done(name));
  fs::rename(in.folder / "done" / (name + ".json"), in.folder / (name + ".json"));
  in.start();
  CHECK(in.is_done(name + ".json"));
  CHECK_FALSE(in.is_waiting(name + ".json"));
}

TEST_CASE("what is no scan in any way fails, and what has another ending is not looked at") {
  Watched in(FolderConfig{.patience = seconds(0)});
  write(in.folder / "2026-03-01T08-00-00Z.pcd", "nonsense");
  write(in.folder / "2026-03-01T08-00-00Z.zip", "nonsense");
  in.settle();
  CHECK(in.has_failed("2026-03-01T08-00-00Z.pcd"));
  CHECK(in.is_waiting("2026-03-01T08-00-00Z.zip"));
}

}  // namespace
}  // namespace raywatch::testing
