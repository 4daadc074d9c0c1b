#include "storage/migrations.hpp"

#include <string>

#include "storage/data_dir.hpp"

namespace raywatch {
namespace {

void set_up_new_file(Database& database, const Migrations& migrations) {
  // These three only take effect in this order and before the first table.
  database.run_script("PRAGMA page_size = " + std::to_string(migrations.page_bytes));
  database.run_script("PRAGMA auto_vacuum = INCREMENTAL");
  database.run_script("PRAGMA journal_mode = WAL");
  database.run_script("PRAGMA application_id = " + std::to_string(migrations.application_id));
}

void require_own_file(Database& database, const Migrations& migrations, std::int64_t version) {
  if (database.find<std::int64_t>("PRAGMA application_id") != migrations.application_id) {
    throw StorageError(database.file().string() + " is not a file of raywatch's store; give another data directory");
  }
  const auto newest = static_cast<std::int64_t>(migrations.steps.size());
  if (version > newest) {
    throw StorageError(database.file().string() + " has schema version " + std::to_string(version) +
                       ", but this program knows versions up to " + std::to_string(newest) +
                       "; use the raywatch that wrote it, or a newer one");
  }
}

void copy_file_before(Database& database, std::size_t new_version) {
  const std::filesystem::path target = database.file().string() + ".before-v" + std::to_string(new_version);
  const std::filesystem::path partial = target.string() + ".partial";
  std::filesystem::remove(partial);
  database.copy_to(partial);
  sync_file(partial);
  std::filesystem::rename(partial, target);
  sync_directory(target.parent_path().empty() ? "." : target.parent_path());
}

}  // namespace

void migrate(Database& database, const Migrations& migrations, CopyBefore copy) {
  if (database.find<std::int64_t>("SELECT count(*) FROM sqlite_schema") == 0) set_up_new_file(database, migrations);
  const std::int64_t version = database.find<std::int64_t>("PRAGMA user_version").value_or(0);
  require_own_file(database, migrations, version);
  if (copy == CopyBefore::yes && version > 0 && version < static_cast<std::int64_t>(migrations.steps.size())) {
    copy_file_before(database, migrations.steps.size());
  }
  for (auto step = static_cast<std::size_t>(version); step < migrations.steps.size(); ++step) {
    database.transact([&] {
      database.run_script(std::string(migrations.steps[step]));
      database.run_script("PRAGMA user_version = " + std::to_string(step + 1));
    });
  }
}

}  // namespace raywatch
