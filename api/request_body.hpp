#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "core/error.hpp"

namespace raywatch {

/// The refusal of content with more than `max_bytes`.
TooLarge too_large(std::uint64_t max_bytes);

/// The content of a request, which is read once and never held as a whole unless it is small.
class RequestBody {
 public:
  using Take = std::function<bool(std::span<const char>)>;  ///< false: no more
  using Source = std::function<bool(const Take&)>;          ///< false: it broke off, or `take` did not want more

  struct Framing {
    bool present = false;                 ///< the request has content
    std::optional<std::uint64_t> length;  ///< Content-Length
    std::string content_type;
    std::string encoding;  ///< Content-Encoding; when there is one, the length is not that of the content
  };
  RequestBody(Source source, Framing framing) : source_(std::move(source)), framing_(std::move(framing)) {}

  const std::string& content_type() const { return framing_.content_type; }
  bool present() const { return framing_.present; }
  const std::optional<std::uint64_t>& length() const { return framing_.length; }  ///< as announced
  bool finished() const { return finished_ || !framing_.present; }  ///< nothing of it is left on the connection

  /// Hands the content to `take` piece by piece.
  /// @throws TooLarge as soon as it is known that there are more than `max_bytes`, before the first byte when the
  /// length is announced; HttpError (400) when the content ends early; what `take` throws.
  void read(std::uint64_t max_bytes, const std::function<void(std::span<const char>)>& take);

  /// All of it, for what is small.
  std::string text(std::uint64_t max_bytes);

 private:
  Source source_;
  Framing framing_;
  bool finished_ = false;
};

}  // namespace raywatch
