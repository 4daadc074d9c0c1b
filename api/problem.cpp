#include "api/problem.hpp"

#include <new>

#include "api/json.hpp"

namespace raywatch {
namespace {

Problem make(int status, const char* name, const char* title, const std::string& detail) {
  Problem problem;
  problem.status = status;
  problem.name = name;
  problem.title = title;
  problem.detail = detail;
  return problem;
}

}  // namespace

Problem bad_request(const std::string& detail) {
  return make(400, "bad-request", "The request is not valid HTTP", detail);
}

Problem no_such_route(const std::string& path) {
  return make(404, "no-such-route", "There is nothing at this address", "No route matches '" + path + "'.");
}

Problem method_not_allowed(const std::string& allow) {
  Problem problem = make(405, "method-not-allowed", "The address does not take this method", "Allowed here: " + allow);
  problem.allow = allow;
  return problem;
}

Problem unsupported_media_type(const std::string& detail) {
  return make(415, "unsupported-media-type", "The content is of a type that is not read here", detail);
}

Problem foreign_origin(const std::string& detail) {
  return make(403, "foreign-origin", "Writes from other web origins are refused", detail);
}

Problem foreign_host(const std::string& detail) {
  return make(403, "foreign-host", "The Host header names another machine", detail);
}

Problem not_ready(const std::string& detail) { return make(503, "not-ready", "The daemon is not ready", detail); }

Problem problem_of_status(int status) {
  switch (status) {
    case 404:
      return no_such_route("");
    case 413:
      return make(413, "too-large", "The content is too large", "The content is larger than what is taken.");
    case 414:
      return make(414, "address-too-long", "The address is too long", "At most 8192 bytes are read.");
    case 415:
      return unsupported_media_type("The Content-Encoding is unknown; gzip, deflate and br are read.");
    default:
      break;
  }
  if (status >= 400 && status < 500) {
    Problem problem = bad_request("The request line, a header or the framing of the content is malformed.");
    problem.status = status;
    return problem;
  }
  return make(500, "internal-error", "The daemon failed", "The request could not be carried out.");
}

Problem problem_of(std::exception_ptr failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const HttpError& error) {
    return error.problem();
  } catch (const InvalidInput& error) {
    Problem problem = make(422, "invalid-input", "The input is not acceptable", error.what());
    problem.errors = error.fields();
    return problem;
  } catch (const UnsupportedFormat& error) {
    return make(415, "unsupported-format", "The content is in no format that is read", error.what());
  } catch (const TooLarge& error) {
    return make(413, "too-large", "The content is too large", error.what());
  } catch (const NotFound& error) {
    return make(404, "not-found", "What was asked for does not exist", error.what());
  } catch (const Conflict& error) {
    Problem problem = make(409, "conflict", "The request contradicts what is stored", error.what());
    problem.errors = error.fields();
    return problem;
  } catch (const PreconditionFailed& error) {
    return make(412, "precondition-failed", "What is stored has changed meanwhile", error.what());
  } catch (const Overloaded& error) {
    Problem problem = make(503, "overloaded", "There is no room for more work now", error.what());
    problem.retry_after = error.retry_after();
    return problem;
  } catch (const DiskFull& error) {
    return make(507, "disk-full", "The disk is full", error.what());
  } catch (const CorruptData& error) {
    return make(500, "corrupt-data", "Stored data is damaged", error.what());
  } catch (const StorageError& error) {
    return make(500, "storage-error", "The store cannot be used", error.what());
  } catch (const std::bad_alloc&) {
    return make(503, "out-of-memory", "There is not enough memory", "The request needs more memory than there is.");
  } catch (const std::exception& error) {
    return make(500, "internal-error", "The daemon failed", error.what());
  } catch (...) {
    return problem_of_status(500);
  }
}

HttpAnswer to_answer(const Problem& problem) {
  Json json = {{"type", "urn:raywatch:problem:" + problem.name},
               {"title", problem.title},
               {"status", problem.status},
               {"detail", problem.detail}};
  if (!problem.errors.empty()) {
    json["errors"] = Json::array();
    for (const FieldError& error : problem.errors) {
      json["errors"].push_back({{"field", error.field}, {"message", error.message}});
    }
  }
  HttpAnswer answer = json_answer(json, problem.status);
  answer.content_type = "application/problem+json";
  if (problem.retry_after) answer.set_header("Retry-After", std::to_string(problem.retry_after->count()));
  if (problem.allow) answer.set_header("Allow", *problem.allow);
  return answer;
}

}  // namespace raywatch
