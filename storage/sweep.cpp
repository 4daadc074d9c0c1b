#include "storage/sweep.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include "storage/payload_rows.hpp"

namespace raywatch {
namespace {

std::vector<std::int64_t> numbers(Statement& rows) {
  std::vector<std::int64_t> all;
  while (rows.next()) all.push_back(rows.take<std::int64_t>());
  return all;
}

std::vector<std::int64_t> owned_keys(Database& metadata, const std::string& file) {
  Statement rows(metadata,
                 "SELECT payload_key FROM scans INDEXED BY scans_by_payload WHERE payload_file = ?1 UNION "
                 "SELECT payload_key FROM comparisons INDEXED BY comparisons_by_payload WHERE payload_file = ?1 UNION "
                 "SELECT payload_key FROM surveys INDEXED BY surveys_by_payload WHERE payload_file = ?1 ORDER BY 1");
  rows.bind(file);
  return numbers(rows);
}

std::vector<std::int64_t> stored_keys(PayloadFiles& files, const std::string& file) {
  Statement rows(files.writer(file), "SELECT id FROM payloads ORDER BY id");
  return numbers(rows);
}

std::vector<std::int64_t> difference(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b) {
  std::vector<std::int64_t> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return rest;
}

/// A file that was lost or emptied would begin to count again, and old records would lead to new payloads.
void keep_keys_used(Database& payloads, std::int64_t last) {
  payloads.run(
      "INSERT INTO sqlite_sequence (name, seq) SELECT 'payloads', 0 "
      "WHERE NOT EXISTS (SELECT 1 FROM sqlite_sequence WHERE name = 'payloads')");
  payloads.run("UPDATE sqlite_sequence SET seq = max(seq, ?) WHERE name = 'payloads'", last);
}

void sweep_file(Database& metadata, PayloadFiles& files, const std::string& file, OpenReport& report) {
  const std::vector<std::int64_t> owned = owned_keys(metadata, file);
  const std::vector<std::int64_t> stored = stored_keys(files, file);
  const std::vector<std::int64_t> orphans = difference(stored, owned);
  report.swept_payloads += orphans.size();
  if (owned.empty()) return files.remove(file);
  if (!orphans.empty()) delete_payloads(files, file, orphans);
  if (const std::vector<std::int64_t> missing = difference(owned, stored); !missing.empty()) {
    keep_keys_used(files.writer(file), owned.back());
    report.warnings.push_back(file + ": " + std::to_string(missing.size()) +
                              " payloads are missing: restore the file from a backup");
  }
}

/// The files that a table refers to, each found by one step through its index.
void add_referenced(Database& metadata, const std::string& table, std::set<std::string>& files) {
  std::string last;
  const std::string next = "SELECT payload_file FROM " + table + " INDEXED BY " + table +
                           "_by_payload WHERE payload_file > ? ORDER BY 1 LIMIT 1";
  while (const auto file = metadata.find<std::string>(next, last)) {
    files.insert(*file);
    last = *file;
  }
}

std::set<std::string> all_files(Database& metadata, const PayloadFiles& files) {
  const std::vector<std::string> on_disk = files.on_disk();
  std::set<std::string> all(on_disk.begin(), on_disk.end());
  add_referenced(metadata, "scans", all);
  add_referenced(metadata, "comparisons", all);
  add_referenced(metadata, "surveys", all);
  return all;
}

}  // namespace

void sweep_payloads(Database& metadata, PayloadFiles& files, OpenReport& report) {
  for (const std::string& file : all_files(metadata, files)) {
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
