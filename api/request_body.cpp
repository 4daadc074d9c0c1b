#include "api/request_body.hpp"

#include <exception>

#include "api/problem.hpp"

namespace raywatch {

TooLarge too_large(std::uint64_t max_bytes) {
  return TooLarge("The content is larger than " + std::to_string(max_bytes) + " bytes, the most that is taken here.");
}

void RequestBody::read(std::uint64_t max_bytes, const std::function<void(std::span<const char>)>& take) {
  if (!framing_.present) return;
  if (framing_.length && *framing_.length > max_bytes) throw too_large(max_bytes);
  std::uint64_t received = 0;
  std::exception_ptr failure;  // not thrown through the HTTP library, which was not written for that
  const bool complete = source_([&](std::span<const char> bytes) {
    try {
      received += bytes.size();
      if (received > max_bytes) throw too_large(max_bytes);
      take(bytes);
      return true;
    } catch (...) {
      failure = std::current_exception();
      return false;
    }
  });
  if (failure) std::rethrow_exception(failure);
  if (!complete && !framing_.encoding.empty()) {
    throw HttpError(bad_request("The content is not " + framing_.encoding +
                                ", as Content-Encoding says, or it broke off: " + std::to_string(received) +
                                " bytes could be read of it."));
  }
  if (!complete || (framing_.length && framing_.encoding.empty() && received != *framing_.length)) {
    throw HttpError(bad_request("The content broke off after " + std::to_string(received) + " bytes."));
  }
  finished_ = true;
}

std::string RequestBody::text(std::uint64_t max_bytes) {
  std::string content;
  read(max_bytes, [&](std::span<const char> bytes) { content.append(bytes.data(), bytes.size()); });
  return content;
}

}  // namespace raywatch
