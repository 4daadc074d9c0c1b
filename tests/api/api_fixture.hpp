#pragma once

#include <httplib.h>
#undef _res

#include <initializer_list>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "server/daemon.hpp"
#include "tests/api/contract.hpp"
#include "tests/api/wall_scan.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch::testing {

/// An answer, which was already held against the contract.
struct Reply {
  int status = 0;
  httplib::Headers headers;
  std::string body;

  nlohmann::json json() const { return nlohmann::json::parse(body); }
  std::string header(const std::string& name) const;
  /// The last word of the problem's type: "invalid-input".
  std::string problem() const;
  /// The message about a field; empty when there is none.
  std::string complaint_about(const std::string& field) const;
};

/// A real daemon on a free port with an empty store, and a client that holds every answer against the contract.
class ApiFixture {
 public:
  ApiFixture() : ApiFixture(DaemonConfig{}) {}
  explicit ApiFixture(DaemonConfig config);

  Reply get(const std::string& target, const httplib::Headers& headers = {});
  Reply head(const std::string& target, const httplib::Headers& headers = {});
  Reply post(const std::string& target, const nlohmann::json& json, const httplib::Headers& headers = {});
  Reply patch(const std::string& target, const nlohmann::json& json, const httplib::Headers& headers = {});
  Reply remove(const std::string& target, const httplib::Headers& headers = {});
  Reply send(const std::string& method, const std::string& target, const std::string& body,
             const httplib::Headers& headers = {});

  /// The site "yard" with the sensor "gate", at `wall_pose`.
  void make_site_and_sensor();
  /// Uploads a scan of the wall from "gate" and waits for its comparison. @returns the scan.
  nlohmann::json upload(int number, const WallScene& scene = {});
  Reply upload_bytes(const std::string& bytes, const std::string& query, const httplib::Headers& headers = {});

  /// The number of files where bodies are received.
  std::size_t spooled_files() const;
  std::uint16_t port() const { return daemon_->port(); }
  const std::filesystem::path& folder() const { return folder_.path(); }
  const std::filesystem::path& data_dir() const { return data_dir_; }

 private:
  static Reply checked(const std::string& method, const std::string& target, const httplib::Result& result);

  TempDir folder_;
  std::filesystem::path data_dir_, spool_dir_;
  std::unique_ptr<Daemon> daemon_;
  std::unique_ptr<httplib::Client> client_;
};

/// The fixture's clock: one day after the first scan.
inline Time fixture_now() { return wall_time(24 * 60); }

}  // namespace raywatch::testing
