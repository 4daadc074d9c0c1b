#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/server_client.hpp"
#include "storage/formats/scan_file.hpp"

namespace raywatch {

/// What is uploaded, and as what.
struct UploadOptions {
  std::optional<std::string> sensor;   ///< not given: the side-cars name it
  std::optional<std::string> site;     ///< where the sensor must be
  bool create = false;                 ///< make the site and the sensor when they are missing
  std::optional<std::string> profile;  ///< of a site that is made
  std::optional<std::string> format;   ///< of all files; not given: decided from each
  std::chrono::seconds patience{300};  ///< how long one file is tried again while the server is busy or away
};

/// A scan of a file that is on the server.
struct UploadedScan {
  std::filesystem::path file;
  std::int64_t id = 0;
};

struct UploadSummary {
  std::size_t stored = 0, already_there = 0, failed = 0;
  std::vector<UploadedScan> scans;  ///< of the files that did not fail
};

/// Called with a line a file.
using UploadReport = std::function<void(const std::string& line)>;

/// The scan files among `paths`: files as given, directories by the endings that are known, and all below them. In the
/// order of the capture times in their side-cars, then of their names, so that each is compared with what was before
/// it.
/// @throws InvalidInput when a path is not there, or a directory holds no scan file.
std::vector<std::filesystem::path> find_scan_files(const std::vector<std::filesystem::path>& paths);

/// Uploads files one after the other. A file that fails does not stop the others; safe to repeat. A server that does
/// not answer yet is waited for, for a few seconds.
/// @throws Error when the server cannot be reached at all, is no daemon, or refuses the sensor.
UploadSummary upload_files(ServerClient& server, const std::vector<std::filesystem::path>& files,
                           const UploadOptions& options, const UploadReport& report);

}  // namespace raywatch
