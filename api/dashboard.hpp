#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "api/answer.hpp"

namespace raywatch {

/// What of a GET or HEAD request decides about a file.
struct FileRequest {
  std::string_view path;  ///< as in the request line, still percent-encoded, without the query
  std::optional<std::string> accept = {}, accept_encoding = {}, if_none_match = {};
};

/// The dashboard's built files, which are read once and served from memory: a request only ever looks up a name that
/// was found then, so that no path leads out of the directory. They lie in a directory rather than in the program, so
/// that the program builds without Node.js and a dashboard can be put beside it later. Immutable.
class Dashboard {
 public:
  Dashboard() = default;  ///< built without: answers what would be right

  /// @throws InvalidInput when `directory` holds no built dashboard, or cannot be read.
  static Dashboard read(const std::filesystem::path& directory);

  /// The file at this address; the page itself for addresses that only the page knows, when a page is asked for.
  /// @returns nothing for all else.
  std::optional<HttpAnswer> answer(const FileRequest& request) const;

 private:
  struct Content {
    std::string bytes, tag;
  };
  /// One file, as it is and as the build compressed it.
  struct File {
    std::string content_type;
    std::map<std::string, Content, std::less<>> by_encoding;  ///< "", "br", "gzip"
  };
  HttpAnswer answer_with(const std::string& address, const File& file, const FileRequest& request) const;

  std::map<std::string, File, std::less<>> files_;  ///< by address: "/assets/index-1a2b3c.js"
};

}  // namespace raywatch
