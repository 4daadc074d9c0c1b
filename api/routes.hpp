#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/answer.hpp"

namespace raywatch {

struct Call;

/// One row of the HTTP contract.
struct Route {
  std::string_view method;
  std::string_view pattern;  ///< "/api/v1/scans/{id}": each {...} stands for one segment
  HttpAnswer (*handle)(Call&);
  std::string_view summary;
};

/// Every route there is.
std::span<const Route> routes();

/// Whether an address is the API's, for whatever method: it lies in the API's prefix, or is a route beside it.
/// @param path still percent-encoded.
/// @throws HttpError (400) for a broken %-escape.
bool belongs_to_api(std::string_view path);

/// The route of a request and what its {...} stand for.
struct RouteMatch {
  const Route* route = nullptr;
  std::vector<std::string> values;
};

/// Finds the route of a request. HEAD goes where GET goes.
/// @param path still percent-encoded.
/// @throws HttpError: 404 when no pattern matches, 405 when one does, but not for this method.
RouteMatch find_route(std::string_view method, std::string_view path);

/// The methods that an address takes, for the `Allow` header. @throws HttpError (404).
std::string allowed_methods(std::string_view path);

}  // namespace raywatch
