#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "api/answer.hpp"
#include "api/http_server.hpp"
#include "api/query.hpp"
#include "api/request_body.hpp"
#include "api/services.hpp"

namespace raywatch {

class StreamSlots;

/// Answers given since the start, by the first digit of their status.
struct HttpStatistics {
  std::array<std::atomic<std::uint64_t>, 6> answers{};
  void count(int status) { ++answers[static_cast<std::size_t>(status / 100 % 6)]; }
};

/// One request, as an endpoint sees it.
struct Call {
  const Services& services;
  const HttpConfig& config;
  const HttpStatistics& statistics;
  StreamSlots& streams;
  std::vector<std::string> path;  ///< what stands for the {...} of the route's pattern, decoded, in their order
  Query query;
  RequestBody& body;
  std::function<std::optional<std::string>(const std::string&)> header;
  std::function<bool()> abandoned;  ///< the client went away, or the server is stopping: nobody waits for the answer
};

}  // namespace raywatch
