#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <sstream>

#include "api/sha256.hpp"
#include "tests/api/api_fixture.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;

const std::string kQuery = "sensor=gate&captured_at=2026-03-01T08:00:00Z";

std::string wall_pcd() { return pcd_of(wall_points({}), wall_pose()); }

/// Checks that a refused upload left nothing behind and that the daemon still serves.
void check_untouched(ApiFixture& api, std::size_t scans) {
  CHECK_EQ(api.get("/api/v1/scans").json()["items"].size(), scans);
  CHECK_EQ(api.spooled_files(), 0);
  CHECK_EQ(api.get("/readyz").status, 200);
}

TEST_CASE("an uploaded scan is stored as it came") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string bytes = wall_pcd();
  const Reply reply = api.upload_bytes(bytes, kQuery);
  REQUIRE_EQ(reply.status, 201);
  const json scan = reply.json();
  CHECK_EQ(reply.header("Location"), "/api/v1/scans/" + std::to_string(scan["id"].get<int>()));
  CHECK_EQ(scan["site"], "yard");
  CHECK_EQ(scan["sensor"], "gate");
  CHECK_EQ(scan["captured_at"], "2026-03-01T08:00:00Z");
  CHECK_EQ(scan["received_at"], "2026-03-02T08:00:00Z");
  CHECK_EQ(scan["points"], kWallPoints);
  CHECK_EQ(scan["sha256"], sha256_hex(bytes));
  CHECK_EQ(scan["pose"]["position_m"], json({100.0, 200.0, 1.5}));
  CHECK_EQ(scan["pose"]["orientation_xyzw"], json({0.0, 0.0, 1.0, 0.0}));
  CHECK_EQ(scan["registration"]["state"], "none");
  CHECK_EQ(scan["pinned"], false);
  CHECK_EQ(api.spooled_files(), 0);
}

TEST_CASE("with Prefer: wait the answer comes after the comparison and says so") {
  ApiFixture api;
  api.make_site_and_sensor();
  const Reply reply = api.upload_bytes(wall_pcd(), kQuery, {{"Prefer", "respond-async, wait=50"}});
  REQUIRE_EQ(reply.status, 201);
  CHECK_EQ(reply.header("Preference-Applied"), "wait=50");
  const json scan = reply.json();
  CHECK_EQ(scan["state"], "compared");
  REQUIRE_EQ(scan["comparisons"].size(), 2);
  CHECK_EQ(scan["comparisons"][0]["id"], scan["comparison"]);
  CHECK_EQ(scan["comparisons"][0]["reference"], "previous");
  CHECK_EQ(scan["comparisons"][1]["reference"], "baseline");
}

TEST_CASE("a wait is bounded, and one that is not understood is ignored") {
  DaemonConfig config;
  config.http.max_wait_s = 20;
  ApiFixture api(config);
  api.make_site_and_sensor();
  CHECK_EQ(api.upload_bytes(wall_pcd(), kQuery, {{"Prefer", "wait=9999"}}).header("Preference-Applied"), "wait=20");
  CHECK_EQ(api.upload_bytes(wall_pcd(), kQuery, {{"Prefer", "wait=soon"}}).header("Preference-Applied"), "");
  CHECK_EQ(api.upload_bytes(wall_pcd(), kQuery).header("Preference-Applied"), "");
}

TEST_CASE("the same bytes again are answered with 200 and stored once") {
  ApiFixture api;
  api.make_site_and_sensor();
  const json first = api.upload_bytes(wall_pcd(), kQuery).json();
  const Reply again = api.upload_bytes(wall_pcd(), kQuery);
  CHECK_EQ(again.status, 200);
  CHECK_EQ(again.json()["id"], first["id"]);
  check_untouched(api, 1);
}

TEST_CASE("other bytes for the same sensor and time are a conflict") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.upload_bytes(wall_pcd(), kQuery);
  const Reply reply = api.upload_bytes(pcd_of(wall_points({.box = true}), wall_pose()), kQuery);
  CHECK_EQ(reply.status, 409);
  CHECK_EQ(reply.problem(), "conflict");
  check_untouched(api, 1);
}

TEST_CASE("the same bytes with another pose or frame are a conflict that says what differs and what can be done") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string points = "1 2 3\n4 5 6\n7 8 9.5\n", query = kQuery + "&format=xyz&pose=10,20,1.5,0,0,0,1";
  const json first = api.upload_bytes(points, query).json();
  CHECK_EQ(api.upload_bytes(points, query).status, 200);
  CHECK_EQ(api.upload_bytes(points, query + ".0").status, 200);  // the same pose, written in another way

  const Reply elsewhere = api.upload_bytes(points, kQuery + "&format=xyz&pose=10,20.5,1.5,0,0,0,1");
  CHECK_EQ(elsewhere.status, 409);
  CHECK_EQ(elsewhere.problem(), "conflict");
  const std::string id = first["id"].dump();
  CHECK_EQ(elsewhere.complaint_about("pose"), "differs from that of scan " + id + " by 0.5 m and 0 degrees");
  CHECK_NE(elsewhere.json()["detail"].get<std::string>().find("delete scan " + id + " first"), std::string::npos);
  const Reply turned = api.upload_bytes(points, kQuery + "&format=xyz&pose=10,20,1.5,0,0,1,0");
  CHECK_EQ(turned.complaint_about("pose"), "differs from that of scan " + id + " by 0 m and 180 degrees");
  const Reply in_world = api.upload_bytes(points, query + "&frame=world");
  CHECK_EQ(in_world.status, 409);
  CHECK_NE(in_world.complaint_about("frame"), "");
  CHECK_EQ(api.get("/api/v1/scans/" + id).json()["pose"], first["pose"]);
  check_untouched(api, 1);
}

TEST_CASE("what says nothing of its pose may come again after its sensor got another one") {
  ApiFixture api;
  api.make_site_and_sensor();
  const auto put_sensor = [&](double x_m) {
    api.patch("/api/v1/sensors/gate", {{"pose", {{"position_m", {x_m, 8, 9}}, {"orientation_xyzw", {0, 0, 0, 1}}}}});
  };
  const std::string points = "1 2 3\n4 5 6\n7 8 9.5\n", query = kQuery + "&format=xyz";
  put_sensor(7);
  const json first = api.upload_bytes(points, query).json();
  put_sensor(70);
  const Reply again = api.upload_bytes(points, query);
  CHECK_EQ(again.status, 200);
  CHECK_EQ(again.json()["pose"], first["pose"]);
}

TEST_CASE("a PTX file with several scans is answered with all of them") {
  ApiFixture api;
  api.make_site_and_sensor();
  std::ostringstream ptx;
  for (int scan = 0; scan < 2; ++scan) {
    const int x_m = 5 + scan;
    ptx << "2\n2\n" << x_m << " 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n" << x_m << " 0 0 1\n";
    for (int point = 0; point < 4; ++point) ptx << 3 + point << " 1 0.5 0.5\n";
  }
  const Reply reply = api.upload_bytes(ptx.str(), kQuery);
  REQUIRE_EQ(reply.status, 201);
  REQUIRE_EQ(reply.json()["items"].size(), 2);
  const json first = reply.json()["items"][0];
  CHECK_EQ(first["pose"]["position_m"], json({5.0, 0.0, 0.0}));
  CHECK_EQ(first["sha256"], sha256_hex(ptx.str()) + "#1");
  CHECK_EQ(api.upload_bytes(ptx.str(), kQuery).status, 200);
}

TEST_CASE("the query wins over the file") {
  ApiFixture api;
  api.make_site_and_sensor();
  const Reply reply = api.upload_bytes(wall_pcd(), kQuery + "&pose=1,2,3,0,0,0,1");
  REQUIRE_EQ(reply.status, 201);
  CHECK_EQ(reply.json()["pose"]["position_m"], json({1.0, 2.0, 3.0}));
}

TEST_CASE("the sensor's fixed pose serves when neither the query nor the file says anything") {
  ApiFixture api;
  api.make_site_and_sensor();
  api.patch("/api/v1/sensors/gate", {{"pose", {{"position_m", {7, 8, 9}}, {"orientation_xyzw", {0, 0, 0, 1}}}}});
  const Reply reply = api.upload_bytes("1 2 3\n4 5 6\n7 8 9.5\n", kQuery + "&format=xyz");
  REQUIRE_EQ(reply.status, 201);
  CHECK_EQ(reply.json()["pose"]["position_m"], json({7.0, 8.0, 9.0}));
}

TEST_CASE("a capture time may have any offset") {
  ApiFixture api;
  api.make_site_and_sensor();
  const Reply reply = api.upload_bytes(wall_pcd(), "sensor=gate&captured_at=2026-03-01T10:00:00.25%2B01:00");
  REQUIRE_EQ(reply.status, 201);
  CHECK_EQ(reply.json()["captured_at"], "2026-03-01T09:00:00.25Z");
}

TEST_CASE("uploads that are not acceptable are refused by their reason and leave nothing behind") {
  ApiFixture api;
  api.make_site_and_sensor();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  PointCloud all_nan;
  for (int i = 0; i < 10; ++i) all_nan.push_back(nan, nan, nan);
  const std::string pcd = wall_pcd();
  std::string promising = pcd;
  promising.replace(promising.find("POINTS 2501"), 11, "POINTS 1000000000000");
  struct Case {
    const char* what;
    std::string bytes, query;
    int status;
    const char* problem;
  };
  const std::vector<Case> cases = {
      {"unknown format", "this is no scan at all", kQuery, 415, "unsupported-format"},
      {"truncated", pcd.substr(0, pcd.size() / 2), kQuery, 422, "invalid-input"},
      {"promises more points than follow", promising, kQuery, 422, "invalid-input"},
      {"no bytes", "", kQuery, 422, "invalid-input"},
      {"no points", pcd_of(PointCloud{}, wall_pose()), kQuery, 422, "invalid-input"},
      {"all points NaN", pcd_of(all_nan, wall_pose()), kQuery, 422, "invalid-input"},
      {"world frame without sensor position", "1 2 3\n4 5 6\n", kQuery + "&format=xyz&frame=world", 422,
       "invalid-input"},
      {"nothing but NaN", "nan nan nan\nnan nan nan\nnan nan nan\n", kQuery, 422, "invalid-input"},
      {"no pose anywhere", "1 2 3\n4 5 6\n", kQuery + "&format=xyz", 422, "invalid-input"},
      {"no time anywhere", pcd, "sensor=gate", 422, "invalid-input"},
      {"non-unit quaternion", pcd, kQuery + "&pose=1,2,3,0,0,0,2", 422, "invalid-input"},
      {"position that is nowhere", pcd, kQuery + "&pose=1e30,2,3,0,0,0,1", 422, "invalid-input"},
      {"pose with six numbers", pcd, kQuery + "&pose=1,2,3,0,0,0", 422, "invalid-input"},
      {"time in the future", pcd, "sensor=gate&captured_at=2026-03-02T08:02:00Z", 422, "invalid-input"},
      {"unknown sensor", pcd, "sensor=nobody&captured_at=2026-03-01T08:00:00Z", 404, "not-found"},
      {"time that is none", pcd, "sensor=gate&captured_at=yesterday", 422, "invalid-input"},
      {"unknown frame", pcd, kQuery + "&frame=moon", 422, "invalid-input"},
      {"format that is none", pcd, kQuery + "&format=jpeg", 422, "invalid-input"},
      {"broken escape", pcd, kQuery + "&frame=%zz", 422, "invalid-input"},
      {"parameter twice", pcd, kQuery + "&sensor=gate", 422, "invalid-input"},
  };
  for (const Case& c : cases) {
    CAPTURE(c.what);
    const Reply reply = api.upload_bytes(c.bytes, c.query);
    CHECK_EQ(reply.status, c.status);
    CHECK_EQ(reply.problem(), c.problem);
    CHECK_NE(reply.json()["detail"], "");
    check_untouched(api, 0);
  }
}

TEST_CASE("what is wrong with the query of an upload is said for all of it at once") {
  ApiFixture api;
  api.make_site_and_sensor();
  const Reply reply = api.upload_bytes(wall_pcd(), "captured_at=now&pose=1&frame=moon&format=jpeg&sensr=gate");
  REQUIRE_EQ(reply.status, 422);
  for (const char* field : {"sensor", "captured_at", "pose", "frame", "format"}) {
    CAPTURE(field);
    CHECK_NE(reply.complaint_about(field), "");
  }
  CHECK_EQ(reply.complaint_about("sensr"), "unknown parameter; did you mean 'sensor'?");
}

TEST_CASE("each complaint about a query has its parameter's name once") {
  ApiFixture api;
  api.make_site_and_sensor();
  const Reply reply = api.upload_bytes(wall_pcd(), kQuery + "&pose=a,2,3,0,0,0,1&frame=moon");
  CHECK_EQ(reply.json()["detail"], "pose: 'a' is not a number; frame: 'moon' is no frame; it is sensor or world");
  CHECK_EQ(api.get("/api/v1/scans/1/points?format=las").json()["detail"],
           "format: 'las' is no format of points; known are pcd, ply, csv, bin and q16");
}

TEST_CASE("bytes without a name that could be KITTI's are asked to say so") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string kitti(16 * 4, '\x01');
  const Reply reply = api.upload_bytes(kitti, kQuery);
  CHECK_EQ(reply.status, 415);
  CHECK_NE(reply.json()["detail"].get<std::string>().find("give format=kitti"), std::string::npos);
  CHECK_EQ(api.upload_bytes(kitti, kQuery + "&format=kitti&pose=0,0,0,0,0,0,1").status, 201);
}

TEST_CASE("what is incomplete is said at once, with a remedy for uploads and for files") {
  ApiFixture api;
  api.make_site_and_sensor();
  const Reply reply = api.upload_bytes("1 2 3\n4 5 6\n7 8 9.5\n", "sensor=gate");
  REQUIRE_EQ(reply.status, 422);
  for (const char* field : {"pose", "captured_at"}) {
    CAPTURE(field);
    const std::string complaint = reply.complaint_about(field);
    CHECK_NE(complaint.find("FILE.json"), std::string::npos);
    CHECK_NE(complaint.find(std::string(field) + "="), std::string::npos);
    CHECK_NE(reply.json()["detail"].get<std::string>().find(complaint), std::string::npos);
  }
}

TEST_CASE("a form that holds a file is not taken for the file, but any other type is") {
  ApiFixture api;
  api.make_site_and_sensor();
  const Reply form = api.upload_bytes("--x\r\n\r\n", kQuery, {{"Content-Type", "multipart/form-data; boundary=x"}});
  CHECK_EQ(form.status, 415);
  CHECK_EQ(form.problem(), "unsupported-media-type");
  const Reply curl = api.upload_bytes(wall_pcd(), kQuery, {{"Content-Type", "application/x-www-form-urlencoded"}});
  CHECK_EQ(curl.status, 201);
}

TEST_CASE("content that is encoded in an unknown way, or not as it says, is refused") {
  ApiFixture api;
  api.make_site_and_sensor();
  for (const char* encoding : {"zstd", "gzip, br", "compress", "vibration"}) {
    CAPTURE(encoding);
    const Reply reply = api.upload_bytes(wall_pcd(), kQuery, {{"Content-Encoding", encoding}});
    CHECK_EQ(reply.status, 415);
    CHECK_EQ(reply.problem(), "unsupported-media-type");
  }
  const Reply plain = api.upload_bytes(wall_pcd(), kQuery, {{"Content-Encoding", "gzip"}});
  CHECK_EQ(plain.status, 400);
  CHECK_NE(plain.json()["detail"].get<std::string>().find("is not gzip"), std::string::npos);
  check_untouched(api, 0);
  CHECK_EQ(api.upload_bytes(wall_pcd(), kQuery, {{"Content-Encoding", "identity"}}).status, 201);
}

TEST_CASE("a body over the limit is refused by its announced length") {
  DaemonConfig config;
  config.http.max_body_bytes = 10'000;
  ApiFixture api(config);
  api.make_site_and_sensor();
  const Reply reply = api.upload_bytes(std::string(10'001, 'x'), kQuery);
  CHECK_EQ(reply.status, 413);
  CHECK_EQ(reply.problem(), "too-large");
  check_untouched(api, 0);
}

TEST_CASE("when the disk is full the daemon says that it is not ready, and what is written is refused") {
  DaemonConfig config;
  config.min_free_disk_bytes = std::uint64_t{1} << 62;
  ApiFixture api(config);
  CHECK_EQ(api.get("/readyz").status, 503);
  CHECK_EQ(api.get("/readyz").problem(), "not-ready");
  const Reply reply = api.post("/api/v1/sites", {{"name", "yard"}});
  CHECK_EQ(reply.status, 507);
  CHECK_EQ(reply.problem(), "disk-full");
  CHECK_EQ(api.get("/api/v1/sites").json()["items"], json::array());
}

TEST_CASE("when the queue is full an upload is told when to come again") {
  DaemonConfig config;
  config.queue_limit = 0;
  ApiFixture api(config);
  api.make_site_and_sensor();
  const Reply reply = api.upload_bytes(wall_pcd(), kQuery);
  CHECK_EQ(reply.status, 503);
  CHECK_EQ(reply.problem(), "overloaded");
  CHECK_GT(std::stoi(reply.header("Retry-After")), 0);
  check_untouched(api, 0);
}

}  // namespace
}  // namespace raywatch::testing
