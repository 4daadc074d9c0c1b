#pragma once

#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "api/answer.hpp"
#include "core/error.hpp"

namespace raywatch {

/// An error as it is told over HTTP (RFC 9457). `type` is "urn:raywatch:problem:" + `name` and never changes.
struct Problem {
  int status = 500;
  std::string name;
  std::string title;
  std::string detail;
  std::vector<FieldError> errors;
  std::optional<std::chrono::seconds> retry_after;
  std::optional<std::string> allow;  ///< the `Allow` header of 405
};

/// Refusals that come from HTTP itself, not from what was asked for.
class HttpError : public Error {
 public:
  explicit HttpError(Problem problem) : Error(problem.detail), problem_(std::move(problem)) {}
  const Problem& problem() const { return problem_; }

 private:
  Problem problem_;
};

/// @{ The problems that HTTP itself has.
Problem bad_request(const std::string& detail);
Problem no_such_route(const std::string& path);
Problem method_not_allowed(const std::string& allow);
Problem unsupported_media_type(const std::string& detail);
Problem foreign_origin(const std::string& detail);
Problem foreign_host(const std::string& detail);
Problem not_ready(const std::string& detail);
Problem problem_of_status(int status);  ///< what the HTTP library refused by itself
/// @}

/// The one table from exceptions to problems. Never throws.
Problem problem_of(std::exception_ptr failure);

HttpAnswer to_answer(const Problem& problem);

}  // namespace raywatch
