#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "storage/sqlite.hpp"

namespace raywatch {

/// How one kind of file of the store came to its present layout. `steps[n]` leads from version n to n + 1; steps only
/// ever go forward, and one that was released is never edited.
struct Migrations {
  std::int64_t application_id = 0;  ///< written into the file, so that another program's file is recognised
  std::int64_t page_bytes = 4096;
  std::span<const std::string_view> steps;
};

/// raywatch.db
const Migrations& metadata_migrations();
/// payload/<site>/<month>.db
const Migrations& payload_migrations();

enum class CopyBefore : bool { no, yes };

/// Brings a file, opened for writing, to the newest version, in one transaction a step. A new file gets its settings
/// (WAL, incremental vacuum) first. With `CopyBefore::yes` a file of an older version is copied to "<file>.before-v<N>"
/// first, N being the new version.
/// @throws StorageError when the file is another program's, or of a newer version than this program knows.
void migrate(Database& database, const Migrations& migrations, CopyBefore copy);

}  // namespace raywatch
