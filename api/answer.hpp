#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace raywatch {

/// What an endpoint gives back.
struct HttpAnswer {
  int status = 200;
  std::string content_type;  ///< empty: no content
  std::string body;
  std::function<void(std::ostream&)> stream;  ///< writes the content instead of `body`, for what is large
  bool endless = false;                       ///< `stream` goes on until the client or the server goes
  std::vector<std::pair<std::string, std::string>> headers;

  void set_header(const std::string& name, const std::string& value) { headers.emplace_back(name, value); }
};

}  // namespace raywatch
