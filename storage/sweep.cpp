#include "storage/sweep.hpp"

#include <algorithm>
#include <iterator>

#include "storage/payload_rows.hpp"

namespace raywatch {
namespace {

std::vector<std::int64_t> numbers(Statement& rows) {
  std::vector<std::int64_t> all;
  while (rows.next()) all.push_back(rows.take<std::int64_t>());
  return all;
}

std::vector<std::int64_t> owned_keys(Database& metadata, const std::string& file) {
  Statement rows(
      metadata,
      "SELECT payload_key FROM scans INDEXED BY scans_by_payload WHERE payload_file = ?1 UNION "
      "SELECT payload_key FROM comparisons INDEXED BY comparisons_by_payload WHERE payload_file = ?1 ORDER BY 1");
  rows.bind(file);
  return numbers(rows);
}

std::vector<std::int64_t> stored_keys(PayloadFiles& files, const std::string& file) {
  Statement rows(files.writer(file), "SELECT id FROM payloads ORDER BY id");
  return numbers(rows);
}

void sweep_file(Database& metadata, PayloadFiles& files, const std::string& file, OpenReport& report) {
  const std::vector<std::int64_t> owned = owned_keys(metadata, file);
  const std::vector<std::int64_t> stored = stored_keys(files, file);
  std::vector<std::int64_t> orphans;
  std::set_difference(stored.begin(), stored.end(), owned.begin(), owned.end(), std::back_inserter(orphans));
  report.swept_payloads += orphans.size();
  if (owned.empty()) {
    files.remove(file);
  } else if (!orphans.empty()) {
    delete_payloads(files, file, orphans);
  }
}

}  // namespace

void sweep_payloads(Database& metadata, PayloadFiles& files, OpenReport& report) {
  for (const std::string& file : files.on_disk()) {
    try {
      sweep_file(metadata, files, file, report);
    } catch (const CorruptData& error) {
      // The other files are whole; whoever reads this one is told.
      report.warnings.emplace_back(error.what());
    }
  }
}

void sweep_spool(const std::filesystem::path& data_dir, OpenReport& report) {
  const std::filesystem::path spool = data_dir / "spool";
  if (!std::filesystem::is_directory(spool)) return;
  std::vector<std::filesystem::path> leftovers;
  for (const auto& entry : std::filesystem::directory_iterator(spool)) leftovers.push_back(entry.path());
  for (const std::filesystem::path& leftover : leftovers) std::filesystem::remove_all(leftover);
  report.swept_spool_files = leftovers.size();
}

}  // namespace raywatch
