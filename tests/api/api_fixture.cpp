#include "tests/api/api_fixture.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "api/problem.hpp"
#include "api/routes.hpp"

namespace raywatch::testing {
namespace {

/// The pattern of the route that a request takes; empty when there is none.
std::string pattern_of(const std::string& method, const std::string& target) {
  try {
    return std::string(find_route(method, target.substr(0, target.find('?'))).route->pattern);
  } catch (const HttpError&) {
    return "";
  }
}

DaemonConfig completed(DaemonConfig config, const std::filesystem::path& folder) {
  config.data_dir = folder / "data";
  config.http.spool_dir = folder / "spool";
  config.http.port = 0;
  config.http.threads = 8;
  config.workers = 1;
  config.compare_threads = 1;
  return config;
}

}  // namespace

std::string Reply::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

std::string Reply::problem() const {
  const std::string type = json().value("type", "");
  return type.substr(type.rfind(':') + 1);
}

std::string Reply::complaint_about(const std::string& field) const {
  for (const nlohmann::json& error : json().value("errors", nlohmann::json::array())) {
    if (error["field"] == field) return error["message"];
  }
  return "";
}

ApiFixture::ApiFixture(DaemonConfig config) : data_dir_(folder_ / "data"), spool_dir_(folder_ / "spool") {
  daemon_ = std::make_unique<Daemon>(completed(std::move(config), folder_.path()), fixture_now);
  client_ = std::make_unique<httplib::Client>("127.0.0.1", daemon_->port());
  client_->set_keep_alive(true);
  client_->set_read_timeout(60, 0);
}

Reply ApiFixture::checked(const std::string& method, const std::string& target, const httplib::Result& result) {
  REQUIRE_MESSAGE(result, "no answer to " << method << " " << target);
  CHECK_EQ(contract().check(method, pattern_of(method, target), result->status,
                            result->get_header_value("Content-Type"), result->body),
           "");
  return {result->status, result->headers, result->body};
}

Reply ApiFixture::get(const std::string& target, const httplib::Headers& headers) {
  return checked("GET", target, client_->Get(target, headers));
}

Reply ApiFixture::head(const std::string& target, const httplib::Headers& headers) {
  return checked("HEAD", target, client_->Head(target, headers));
}

Reply ApiFixture::send(const std::string& method, const std::string& target, const std::string& body,
                       const httplib::Headers& headers) {
  httplib::Request request;
  request.method = method;
  request.path = target;
  request.headers = headers;
  request.body = body;
  return checked(method, target, client_->send(request));
}

Reply ApiFixture::post(const std::string& target, const nlohmann::json& json, const httplib::Headers& headers) {
  return checked("POST", target, client_->Post(target, headers, json.dump(), "application/json"));
}

Reply ApiFixture::patch(const std::string& target, const nlohmann::json& json, const httplib::Headers& headers) {
  return checked("PATCH", target, client_->Patch(target, headers, json.dump(), "application/json"));
}

Reply ApiFixture::remove(const std::string& target, const httplib::Headers& headers) {
  return checked("DELETE", target, client_->Delete(target, headers));
}

void ApiFixture::make_site_and_sensor() {
  REQUIRE_EQ(post("/api/v1/sites", {{"name", "yard"}}).status, 201);
  REQUIRE_EQ(post("/api/v1/sensors", {{"name", "gate"}, {"site", "yard"}}).status, 201);
}

nlohmann::json ApiFixture::upload(int number, const WallScene& scene) {
  const Reply reply =
      upload_bytes(pcd_of(wall_points(scene), wall_pose()),
                   "sensor=gate&captured_at=" + format_rfc3339(wall_time(number)), {{"Prefer", "wait=50"}});
  REQUIRE_EQ(reply.status, 201);
  const nlohmann::json scan = reply.json();
  REQUIRE_EQ(scan["state"], "compared");
  return scan;
}

Reply ApiFixture::upload_bytes(const std::string& bytes, const std::string& query, const httplib::Headers& headers) {
  return send("POST", "/api/v1/scans?" + query, bytes, headers);
}

std::size_t ApiFixture::spooled_files() const {
  if (!std::filesystem::exists(spool_dir_)) return 0;
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(spool_dir_), {}));
}

}  // namespace raywatch::testing
