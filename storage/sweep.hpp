#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "storage/payload_files.hpp"

namespace raywatch {

/// What was found and cleared away when a store was opened.
struct OpenReport {
  bool unclean_stop = false;            ///< the store before was not closed
  std::uint64_t swept_payloads = 0;     ///< payloads that no record refers to
  std::uint64_t swept_spool_files = 0;  ///< uploads that were never finished
  std::vector<std::string> warnings;    ///< payload files that are damaged, payloads that are missing
};

/// Deletes payloads that neither scans nor comparisons refer to: a stop between the payload's commit and the record's
/// leaves them. Payload files that hold nothing any more are deleted. Only on the writer thread, before anybody reads.
void sweep_payloads(Database& metadata, PayloadFiles& files, OpenReport& report);

/// Deletes what stands in the directory of unfinished uploads.
void sweep_spool(const std::filesystem::path& data_dir, OpenReport& report);

}  // namespace raywatch
