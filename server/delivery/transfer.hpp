#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "server/delivery/delivery_config.hpp"

namespace raywatch {

/// How a transfer ended.
struct TransferEnd {
  bool complete = false;  ///< both sides said all; the receiver may have refused all the same
  bool interrupted = false;
  long response_code = 0;  ///< the last of the receiver; 0: none
  std::string error;       ///< when not complete
  std::string content;     ///< the beginning of the answer
  std::optional<std::chrono::seconds> retry_after;
};

/// One transfer by libcurl. It follows no redirects, reads no more than a little of the answer, keeps to the timeouts,
/// and ends at once when it is asked to stop, even while a name is looked up. Use it once. Not thread-safe.
class Transfer {
 public:
  /// @param schemes that the address may have, such as "http,https"
  Transfer(const std::string& url, const std::string& schemes, const SenderConfig& config);
  ~Transfer();
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  /// @{ What is to be sent. Texts are copied.
  void post(const std::string& body, const std::vector<std::string>& headers);
  void mail(const std::string& from, const std::vector<std::string>& to, const std::string& message);
  void log_in(const std::string& user, const std::string& password);
  void require_starttls();
  /// Only connects: to see whether somebody is there.
  void only_connect();
  /// @}

  TransferEnd run(const std::stop_token& stop);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether libcurl takes the text for the address of a proxy.
bool is_proxy(const std::string& text);

/// What libcurl needs once, before the first thread that uses it.
class TransferLibrary {
 public:
  TransferLibrary();
  ~TransferLibrary();
  TransferLibrary(const TransferLibrary&) = delete;
  TransferLibrary& operator=(const TransferLibrary&) = delete;
};

}  // namespace raywatch
