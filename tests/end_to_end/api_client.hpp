#pragma once

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/end_to_end/place.hpp"

namespace raywatch::test {

struct ApiReply {
  int status = 0;  ///< 0: nobody answered
  std::string body;
  std::string retry_after;

  nlohmann::json json() const { return nlohmann::json::parse(body); }
};

/// Speaks HTTP with a daemon, as curl would.
class ApiClient {
 public:
  explicit ApiClient(const std::string& url);
  ~ApiClient();

  ApiReply get(const std::string& path);
  ApiReply post(const std::string& path, const nlohmann::json& json);
  /// @param wait how long to wait for the comparison
  ApiReply upload(const PlaceScan& scan, std::chrono::seconds wait = {});

  /// The site "yard" with the sensor "gate".
  void make_site_and_sensor();

  /// Waits until no scan is queued or compared any more. @returns the scans, oldest id first.
  nlohmann::json wait_for_all_scans();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace raywatch::test
