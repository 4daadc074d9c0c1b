#include "tests/end_to_end/api_client.hpp"

#include <doctest/doctest.h>
#include <httplib.h>

#include <algorithm>
#include <thread>

namespace raywatch::test {
namespace {

ApiReply reply_of(const httplib::Result& result) {
  if (!result) return {};
  return {result->status, result->body, result->get_header_value("Retry-After")};
}

}  // namespace

struct ApiClient::Impl {
  explicit Impl(const std::string& url) : client(url) { client.set_read_timeout(std::chrono::minutes(2)); }
  httplib::Client client;
};

ApiClient::ApiClient(const std::string& url) : impl_(std::make_unique<Impl>(url)) {}
ApiClient::~ApiClient() = default;

ApiReply ApiClient::get(const std::string& path) { return reply_of(impl_->client.Get(path)); }

ApiReply ApiClient::post(const std::string& path, const nlohmann::json& json) {
  return reply_of(impl_->client.Post(path, json.dump(), "application/json"));
}

ApiReply ApiClient::upload(const PlaceScan& scan, std::chrono::seconds wait) {
  httplib::Headers headers;
  if (wait.count() > 0) headers.emplace("Prefer", "wait=" + std::to_string(wait.count()));
  const std::string path = httplib::append_query_params(
      "/api/v1/scans", {{"sensor", "gate"}, {"captured_at", scan.time_text()}, {"pose", scan.pose_text()}});
  return reply_of(impl_->client.Post(path, headers, scan.pcd(), "application/octet-stream"));
}

void ApiClient::make_site_and_sensor() {
  REQUIRE(post("/api/v1/sites", {{"name", "yard"}}).status == 201);
  REQUIRE(post("/api/v1/sensors", {{"name", "gate"}, {"site", "yard"}}).status == 201);
}

nlohmann::json ApiClient::wait_for_all_scans() {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  for (;;) {
    const ApiReply reply = get("/api/v1/scans?limit=1000");
    REQUIRE(reply.status == 200);
    nlohmann::json scans = reply.json()["items"];
    std::sort(scans.begin(), scans.end(), [](const nlohmann::json& a, const nlohmann::json& b) {
      return a["id"].get<std::int64_t>() < b["id"].get<std::int64_t>();
    });
    const bool all_ended = std::all_of(scans.begin(), scans.end(), [](const nlohmann::json& scan) {
      return scan["state"] == "compared" || scan["state"] == "failed";
    });
    if (all_ended) return scans;
    REQUIRE(std::chrono::steady_clock::now() < deadline);
    std::this_thread::yield();
  }
}

}  // namespace raywatch::test
