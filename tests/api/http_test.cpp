#include <doctest/doctest.h>

#include <atomic>
#include <fstream>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "tests/api/api_fixture.hpp"
#include "tests/api/raw_client.hpp"

namespace raywatch::testing {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

const std::string kUpload =
    "POST /api/v1/scans?sensor=gate&captured_at=2026-03-01T08:00:00Z HTTP/1.1\r\nHost: localhost\r\n";

/// Settings with which a slow client is dropped soon.
DaemonConfig impatient() {
  DaemonConfig config;
  config.http.stall_timeout = 300ms;
  config.http.idle_timeout = 300ms;
  return config;
}

std::string raw_answer(const ApiFixture& api, const std::string& request) {
  const RawClient client(api.port());
  client.send(request);
  return client.receive_all();
}

std::string chunked(const std::string& bytes, std::size_t chunk) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    const std::string part = bytes.substr(at, chunk);
    char length[20];
    std::snprintf(length, sizeof(length), "%zx\r\n", part.size());
    text += length + part + "\r\n";
  }
  return text + "0\r\n\r\n";
}

TEST_CASE("the program says that it is alive, ready, and what it does") {
  ApiFixture api;
  CHECK_EQ(api.get("/healthz").json(), json{{"status", "ok"}});
  CHECK_EQ(api.get("/readyz").json()["status"], "ready");
  const Reply metrics = api.get("/metrics");
  CHECK_NE(metrics.body.find("\nraywatch_queue_length 0\n"), std::string::npos);
  CHECK_NE(metrics.body.find("raywatch_http_answers_total{status=\"2xx\"} 2\n"), std::string::npos);
}

TEST_CASE("the dashboard is served beside the API, and never in its place") {
  const TempDir folder;
  std::ofstream(folder / "index.html") << std::string(5000, 'x');
  std::ofstream(folder / "index.html.gz") << "compressed once";
  DaemonConfig config;
  config.http.dashboard_dir = folder.path();
  const ApiFixture api(std::move(config));
  const auto ask = [&](const std::string& line, const std::string& more = "") {
    return raw_answer(api, line + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + more + "\r\n");
  };
  const std::string browser = "Accept: text/html,*/*\r\nAccept-Encoding: gzip\r\n";
  for (const char* path : {"/", "/alerts/7?tab=why", "/sensors/gate"}) {
    const std::string page = ask(std::string("GET ") + path, browser);
    CAPTURE(path);
    CHECK(page.starts_with("HTTP/1.1 200"));
    CHECK(page.ends_with("\r\n\r\ncompressed once"));
    CHECK_NE(page.find("Content-Encoding: gzip\r\n"), std::string::npos);
    CHECK_NE(page.find("Content-Security-Policy: default-src 'self'"), std::string::npos);
    CHECK_NE(page.find("X-Content-Type-Options: nosniff\r\n"), std::string::npos);
  }
  const std::string head = ask("HEAD /", browser);
  CHECK_NE(head.find("Content-Length: 15\r\n"), std::string::npos);
  CHECK(head.ends_with("\r\n\r\n"));
  CHECK(ask("GET /healthz", browser).ends_with("{\"status\":\"ok\"}"));
  for (const char* line : {"GET /api/v1/nothing", "GET /api", "POST /alerts", "DELETE /"}) {
    CAPTURE(line);
    CHECK_NE(ask(line, browser + "Content-Length: 0\r\n").find("urn:raywatch:problem:no-such-route"),
             std::string::npos);
  }
}

TEST_CASE("an address that does not exist is a 404 problem") {
  ApiFixture api;
  for (const char* target : {"/", "/nowhere", "/api/v1", "/api/v1/sites/", "/api/v1/sites/a/b", "/api/v2/sites",
                             "//healthz", "/healthz/", "/api/v1/%73%69%74%65", "/HEALTHZ"}) {
    CAPTURE(target);
    const Reply reply = api.get(target);
    CHECK_EQ(reply.status, 404);
    CHECK_EQ(reply.problem(), "no-such-route");
  }
  CHECK_EQ(api.get("/api/v1/sites/%zz").status, 400);
  CHECK_EQ(api.get("/api/v1/sites/%ff").status, 400);
  CHECK_EQ(api.get("/%61pi/v1/sites").status, 200);
}

TEST_CASE("a method that an address does not take is a 405 problem that names those it takes") {
  ApiFixture api;
  const Reply put = api.send("PUT", "/api/v1/sites", "{}");
  CHECK_EQ(put.status, 405);
  CHECK_EQ(put.header("Allow"), "POST, GET, HEAD, OPTIONS");
  CHECK_EQ(api.remove("/healthz").header("Allow"), "GET, HEAD, OPTIONS");
  CHECK_EQ(api.post("/api/v1/sites/yard", json::object()).status, 405);
  for (const std::string method : {"TRACE", "CONNECT"}) {
    CAPTURE(method);
    const std::string answer =
        raw_answer(api, method + " /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    CHECK_EQ(status_of(answer), 405);
  }
  const std::string options =
      raw_answer(api, "OPTIONS /api/v1/changes HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  CHECK_EQ(status_of(options), 204);
  CHECK_NE(options.find("Allow: GET, HEAD, OPTIONS"), std::string::npos);
}

TEST_CASE("HEAD answers as GET does, without the content") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string points = "/api/v1/scans/" + api.upload(0)["id"].dump() + "/points?format=csv";
  for (const std::string& target : {std::string("/healthz"), std::string("/api/v1/sites/yard"), points}) {
    CAPTURE(target);
    const Reply got = api.get(target);
    const Reply head = api.head(target);
    CHECK_EQ(head.status, 200);
    CHECK_EQ(head.body, "");
    CHECK_EQ(head.header("Content-Length"), std::to_string(got.body.size()));
    CHECK_EQ(head.header("ETag"), got.header("ETag"));
  }
  CHECK_EQ(api.head("/api/v1/scans/9").status, 404);
}

TEST_CASE("content that is said to be something else than JSON is not read as JSON") {
  ApiFixture api;
  const std::string body = R"({"name": "yard"})";
  for (const char* type : {"text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x"}) {
    CAPTURE(type);
    const Reply reply = api.send("POST", "/api/v1/sites", body, {{"Content-Type", type}});
    CHECK_EQ(reply.status, 415);
    CHECK_EQ(reply.problem(), "unsupported-media-type");
  }
  CHECK_EQ(api.send("POST", "/api/v1/sites", body, {{"Content-Type", "Application/JSON; charset=utf-8"}}).status, 201);
}

TEST_CASE("malformed JSON is refused with the place where it breaks") {
  ApiFixture api;
  const auto post = [&](const std::string& body) {
    return api.send("POST", "/api/v1/sites", body, {{"Content-Type", "application/json"}});
  };
  const Reply cut = post(R"({"name": )");
  CHECK_EQ(cut.status, 422);
  CHECK_NE(cut.json()["detail"].get<std::string>().find("byte 10"), std::string::npos);
  for (const std::string& body :
       {std::string(""), std::string("{"), std::string("nonsense"), std::string(R"({"name": "a"} {})"),
        std::string("{\"name\": \"\xff\xfe\"}"), std::string("{\"name\": 1e999}"), std::string("{'name': 'a'}"),
        std::string(R"({"name": "a", "name": "b"})"), std::string(100'000, '['),
        std::string("{\"name\": \"a\0b\"}", 15)}) {
    CAPTURE(body.substr(0, 40));
    const Reply reply = post(body);
    CHECK_EQ(reply.status, 422);
    CHECK_EQ(reply.problem(), "invalid-input");
  }
  CHECK_EQ(api.get("/api/v1/sites").json()["items"], json::array());
}

TEST_CASE("text of any kind comes back as JSON") {
  ApiFixture api;
  const std::string name = "\xF0\x9F\x8F\x97 \"quoted\" \xE2\x82\xAC";
  REQUIRE_EQ(api.post("/api/v1/sites", {{"name", name}}).status, 201);
  CHECK_EQ(api.get("/api/v1/sites").json()["items"][0]["name"], name);
  CHECK_EQ(api.get("/api/v1/scans?site=%ff").status, 422);
}

TEST_CASE("JSON content has a limit, whether its length is announced or not") {
  ApiFixture api;
  const std::string large = "{\"name\": \"" + std::string(1 << 20, 'x') + "\"}";
  CHECK_EQ(api.post("/api/v1/sites", json::parse(large)).status, 413);
  const std::string answer =
      raw_answer(api, "POST /api/v1/sites HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n" +
                          chunked(large, 64 << 10));
  CHECK_EQ(status_of(answer), 413);
}

TEST_CASE("a web page of another origin cannot write, but may be told what anybody may read") {
  ApiFixture api;
  const std::string own = "http://127.0.0.1:" + std::to_string(api.port());
  for (const std::string& origin : {std::string("http://evil.example"), std::string("null"),
                                    std::string("http://127.0.0.1:1"), own + ".evil.example"}) {
    CAPTURE(origin);
    const Reply reply = api.post("/api/v1/sites", {{"name", "yard"}}, {{"Origin", origin}});
    CHECK_EQ(reply.status, 403);
    CHECK_EQ(reply.problem(), "foreign-origin");
    CHECK_EQ(api.remove("/api/v1/sites/yard", {{"Origin", origin}}).status, 403);
    CHECK_EQ(api.get("/api/v1/sites", {{"Origin", origin}}).status, 200);
  }
  CHECK_EQ(api.get("/api/v1/sites").json()["items"], json::array());
  CHECK_EQ(api.post("/api/v1/sites", {{"name", "yard"}}, {{"Origin", own}}).status, 201);
}

TEST_CASE("a daemon on loopback answers under loopback's names only") {
  ApiFixture api;
  for (const char* host :
       {"evil.example", "evil.example:8420", "127.0.0.1.evil.example", "192.168.0.1", "localhost.evil", "0.0.0.0"}) {
    CAPTURE(host);
    const Reply reply = api.get("/api/v1/sites", {{"Host", host}});
    CHECK_EQ(reply.status, 403);
    CHECK_EQ(reply.problem(), "foreign-host");
  }
  for (const char* host : {"localhost", "LOCALHOST:80", "127.0.0.1", "127.9.9.9:1", "[::1]:8420"}) {
    CAPTURE(host);
    CHECK_EQ(api.get("/api/v1/sites", {{"Host", host}}).status, 200);
  }
  CHECK_EQ(status_of(raw_answer(api, "GET /healthz HTTP/1.1\r\nConnection: close\r\n\r\n")), 400);
}

TEST_CASE("behind a proxy the public address is the daemon's own, however the proxy passes it on") {
  DaemonConfig config;
  config.delivery.public_url = "https://Watch.example.com/";
  ApiFixture api(config);
  CHECK_EQ(api.get("/api/v1/sites", {{"Host", "watch.example.com"}}).status, 200);
  CHECK_EQ(api.get("/api/v1/sites", {{"Host", "evil.example.com"}}).status, 403);
  const auto make = [&](const std::string& name, const std::string& host, const std::string& origin) {
    return api.post("/api/v1/sites", {{"name", name}}, {{"Host", host}, {"Origin", origin}}).status;
  };
  const std::string origin = "https://watch.example.com", loopback = "127.0.0.1:" + std::to_string(api.port());
  CHECK_EQ(make("passed", "watch.example.com", origin), 201);
  CHECK_EQ(make("rewritten", loopback, origin), 201);
  CHECK_EQ(make("foreign", loopback, "https://watch.example.com.evil.example"), 403);
  CHECK_EQ(make("foreign", loopback, "http://evil.example"), 403);
}

TEST_CASE("no address but loopback is listened on without being allowed to") {
  const TempDir folder;
  DaemonConfig config;
  config.data_dir = folder / "data";
  config.http.port = 0;
  for (const char* host : {"0.0.0.0", "::", "192.168.0.1", "example.org", "127.0.0.1.example.org"}) {
    CAPTURE(host);
    config.http.host = host;
    CHECK_THROWS_AS(Daemon(config, fixture_now), InvalidInput);
  }
  config.http.host = "0.0.0.0";
  config.http.allow_remote = true;
  const Daemon daemon(config, fixture_now);
  httplib::Client client("127.0.0.1", daemon.port());
  CHECK_EQ(client.Get("/healthz")->status, 200);
}

TEST_CASE("two daemons cannot share a port") {
  ApiFixture first;
  const TempDir folder;
  DaemonConfig config;
  config.data_dir = folder / "data";
  config.http.port = first.port();
  CHECK_THROWS_AS(Daemon(config, fixture_now), InvalidInput);
}

TEST_CASE("an upload in chunks is stored like any other, and the connection goes on behind it") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string pcd = pcd_of(wall_points({}), wall_pose());
  const RawClient client(api.port());
  client.send(kUpload + "Transfer-Encoding: chunked\r\n\r\n" + chunked(pcd, 1000) +
              "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string answers = client.receive_all();
  CHECK_EQ(status_of(answers), 201);
  CHECK_EQ(status_of(answers.substr(answers.rfind("HTTP/1.1"))), 200);
  CHECK_EQ(api.get("/api/v1/scans").json()["items"][0]["points"], kWallPoints);
}

TEST_CASE("a body in chunks is refused as soon as it is over the limit") {
  DaemonConfig config;
  config.http.max_body_bytes = 10'000;
  ApiFixture api(config);
  api.make_site_and_sensor();
  const RawClient client(api.port());
  client.send(kUpload + "Transfer-Encoding: chunked\r\n\r\n");
  std::string piece = chunked(std::string(4096, 'x'), 4096);
  piece.resize(piece.size() - 5);  // without the last chunk: this body never ends
  for (int i = 0; i < 5; ++i) client.send(piece);
  CHECK_EQ(status_of(client.receive_all()), 413);
  CHECK_EQ(api.spooled_files(), 0);
}

TEST_CASE("a client that waits for leave to send is told at once that its body is too large") {
  DaemonConfig config;
  config.http.max_body_bytes = 10'000;
  ApiFixture api(config);
  api.make_site_and_sensor();
  const RawClient client(api.port());
  client.send(kUpload + "Content-Length: 10000000000\r\nExpect: 100-continue\r\n\r\n");
  const std::string answer = client.receive_all();
  CHECK_NE(answer.find("HTTP/1.1 413"), std::string::npos);
  CHECK_EQ(answer.find("HTTP/1.1 100"), std::string::npos);
}

TEST_CASE("clients that vanish in the middle of a body leave nothing behind") {
  ApiFixture api;
  api.make_site_and_sensor();
  for (int i = 0; i < 20; ++i) {
    RawClient client(api.port());
    client.send(kUpload + "Content-Length: 100000\r\n\r\n" + std::string(50'000, 'x'));
    if (i % 2 == 0) {
      client.vanish();
    } else {
      client.end_sending();
      CHECK_EQ(status_of(client.receive_all()), 400);
    }
  }
  CHECK_EQ(api.get("/api/v1/scans").json()["items"], json::array());
  CHECK_EQ(api.get("/readyz").status, 200);
}

TEST_CASE("clients that stop sending are dropped, and others are served meanwhile") {
  ApiFixture api(impatient());
  api.make_site_and_sensor();
  const RawClient in_head(api.port()), in_body(api.port()), in_chunk(api.port()), silent(api.port());
  in_head.send("GET /healthz HTT");
  in_body.send(kUpload + "Content-Length: 1000\r\n\r\nxyz");
  in_chunk.send(kUpload + "Transfer-Encoding: chunked\r\n\r\n5\r\nxy");
  CHECK_EQ(api.get("/healthz").status, 200);
  CHECK_EQ(in_head.receive_all(), "");
  CHECK_EQ(status_of(in_body.receive_all()), 400);
  CHECK_EQ(status_of(in_chunk.receive_all()), 400);
  CHECK_EQ(silent.receive_all(), "");
  CHECK_EQ(api.spooled_files(), 0);
}

TEST_CASE("a client that sends a little now and then is dropped, too") {
  DaemonConfig config = impatient();
  config.http.min_client_bytes_per_s = 1'000'000'000;
  ApiFixture api(config);
  api.make_site_and_sensor();
  const RawClient client(api.port());
  client.send(kUpload + "Content-Length: 100000000\r\n\r\n");
  bool open = true;
  for (int i = 0; i < 100'000'000 && open; ++i) {
    open = client.send("x");
    std::this_thread::yield();
  }
  CHECK_FALSE(open);
  CHECK_EQ(api.spooled_files(), 0);
}

TEST_CASE("a client that takes nothing of its answers is dropped") {
  ApiFixture api(impatient());
  api.make_site_and_sensor();
  const std::string target = "/api/v1/scans/" + api.upload(0)["id"].dump() + "/points?format=csv";
  const RawClient client(api.port());
  // More than the buffers of both sides hold: 1000 answers of about 100 kB.
  std::string requests;
  for (int i = 0; i < 1000; ++i) requests += "GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
  bool open = client.send(requests);
  while (open) {
    open = client.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  CHECK_EQ(api.get("/healthz").status, 200);
}

TEST_CASE("a request that is no HTTP is a 400 problem or the end of the connection") {
  ApiFixture api;
  CHECK_EQ(status_of(raw_answer(api, "nonsense\r\n\r\n")), 400);
  CHECK_EQ(status_of(raw_answer(api, "GET /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: x\r\n\r\n")), 400);
  CHECK_EQ(status_of(raw_answer(api, kUpload + "Content-Length: 5\r\nContent-Length: 6\r\n\r\nhello")), 400);
  CHECK_EQ(status_of(raw_answer(api, kUpload + "Content-Length: -5\r\n\r\n")), 400);
  CHECK_EQ(status_of(raw_answer(api, kUpload + "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n")),
           400);
  CHECK_EQ(status_of(raw_answer(api, "GET /" + std::string(9000, 'x') + " HTTP/1.1\r\nHost: localhost\r\n\r\n")), 414);
  std::string headers;
  for (int i = 0; i < 5000; ++i) headers += "X-" + std::to_string(i) + ": " + std::string(100, 'x') + "\r\n";
  const RawClient hoarder(api.port());
  hoarder.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n");
  CHECK_NE(status_of(hoarder.receive_all()), 200);
  CHECK_EQ(api.get("/healthz").status, 200);
}

TEST_CASE("an unread body is not taken for the next request") {
  ApiFixture api;
  const std::string hidden = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const std::string answer =
      raw_answer(api, "POST /nowhere HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + std::to_string(hidden.size()) +
                          "\r\n\r\n" + hidden);
  CHECK_EQ(status_of(answer), 404);
  CHECK_EQ(answer.find("HTTP/1.1 200"), std::string::npos);
}

TEST_CASE("a connection takes many requests, also several at once") {
  ApiFixture api;
  const RawClient client(api.port());
  std::string requests;
  for (int i = 0; i < 50; ++i) requests += "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  client.send(requests + "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string answers = client.receive_all();
  std::size_t count = 0;
  for (auto at = answers.find("HTTP/1.1 200"); at != std::string::npos; at = answers.find("HTTP/1.1 200", at + 1))
    ++count;
  CHECK_EQ(count, 51);
}

TEST_CASE("parallel clients each get their own answers") {
  ApiFixture api;
  api.make_site_and_sensor();
  std::atomic<int> stored = 0, refused = 0;
  std::vector<std::thread> clients;
  for (int c = 0; c < 6; ++c) {
    clients.emplace_back([&, c] {
      httplib::Client client("127.0.0.1", api.port());
      for (int i = 0; i < 10; ++i) {
        // Each name is wanted by two clients: one of them gets it.
        const json site = {{"name", "site " + std::to_string((c / 2) * 10 + i)}};
        const auto reply = client.Post("/api/v1/sites", site.dump(), "application/json");
        if (!reply) continue;
        if (reply->status == 201 && json::parse(reply->body)["name"] == site["name"]) ++stored;
        if (reply->status == 409) ++refused;
      }
    });
  }
  for (std::thread& client : clients) client.join();
  CHECK_EQ(stored, 30);
  CHECK_EQ(refused, 30);
}

TEST_CASE("more connections than threads are served, though the others stay open") {
  ApiFixture api;  // it has 8 threads
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 30; ++i) {
    clients.push_back(std::make_unique<RawClient>(api.port()));
    clients.back()->send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  for (const auto& client : clients) CHECK_EQ(status_of(client->receive_until("}")), 200);
}

TEST_CASE("one of several uploads of the same bytes at the same time is stored") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string pcd = pcd_of(wall_points({}), wall_pose());
  std::atomic<int> stored = 0, repeated = 0;
  std::vector<std::thread> clients;
  for (int c = 0; c < 4; ++c) {
    clients.emplace_back([&] {
      httplib::Client client("127.0.0.1", api.port());
      const auto reply =
          client.Post("/api/v1/scans?sensor=gate&captured_at=2026-03-01T08:00:00Z", pcd, "application/octet-stream");
      if (reply && reply->status == 201) ++stored;
      if (reply && reply->status == 200) ++repeated;
    });
  }
  for (std::thread& client : clients) client.join();
  CHECK_EQ(stored, 1);
  CHECK_EQ(repeated, 3);
}

TEST_CASE("a daemon stops at once though idle clients stay connected") {
  auto api = std::make_unique<ApiFixture>();
  const RawClient idle(api->port()), silent(api->port());
  idle.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  CHECK_EQ(status_of(idle.receive_until("}")), 200);
  api.reset();
  CHECK_EQ(idle.receive_all(), "");
  CHECK_EQ(silent.receive_all(), "");
}

TEST_CASE("a running store is copied on request, into an empty directory only") {
  ApiFixture api;
  api.make_site_and_sensor();
  const std::string directory = (api.folder() / "copy").string();
  const Reply reply = api.post("/api/v1/backup", {{"directory", directory}});
  CHECK_EQ(reply.status, 201);
  CHECK(std::filesystem::exists(api.folder() / "copy" / "raywatch.db"));
  CHECK_EQ(api.post("/api/v1/backup", {{"directory", directory}}).status, 422);
  CHECK_EQ(api.post("/api/v1/backup", {{"directory", "copy"}}).status, 422);
  CHECK_NE(api.post("/api/v1/backup", {{"directory", "/proc/copy"}}).complaint_about("directory"), "");
  CHECK_EQ(api.post("/api/v1/backup", json::object()).complaint_about("directory"), "is required");
}

}  // namespace
}  // namespace raywatch::testing
