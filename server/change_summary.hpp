#pragma once

#include <chrono>
#include <vector>

#include "server/upload_files.hpp"

namespace raywatch {

/// Waits until the daemon has compared uploaded scans, at most `patience`, and reports a line for each: what changed,
/// or that it is still being compared.
/// @throws Error when the server cannot be reached.
void report_changes(ServerClient& server, const std::vector<UploadedScan>& scans, std::chrono::seconds patience,
                    const UploadReport& report);

}  // namespace raywatch
