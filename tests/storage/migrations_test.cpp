#include "storage/migrations.hpp"

#include <doctest/doctest.h>

#include <array>

#include "tests/storage/store_fixture.hpp"

namespace raywatch {
namespace {

constexpr std::array<std::string_view, 3> kSteps{"CREATE TABLE a (x INTEGER) STRICT; INSERT INTO a VALUES (7)",
                                                 "ALTER TABLE a ADD COLUMN y INTEGER; UPDATE a SET y = x + 1",
                                                 "ALTER TABLE a RENAME TO b"};

Migrations first_steps(std::size_t count) {
  return {.application_id = 77, .page_bytes = 4096, .steps = std::span(kSteps).first(count)};
}

TEST_CASE("a file of any earlier version comes to the newest one with its rows") {
  for (std::size_t version = 0; version <= kSteps.size(); ++version) {
    const TempDir directory;
    Database database(directory / "a.db", Database::Access::create);
    if (version > 0) migrate(database, first_steps(version), CopyBefore::yes);
    migrate(database, first_steps(3), CopyBefore::yes);
    CHECK(database.find<int>("SELECT y FROM b") == 8);
    CHECK(database.find<int>("PRAGMA user_version") == 3);
  }
}

TEST_CASE("a file of an older version is copied before it is migrated, a new or current one is not") {
  const TempDir directory;
  Database database(directory / "a.db", Database::Access::create);
  migrate(database, first_steps(1), CopyBefore::yes);
  migrate(database, first_steps(1), CopyBefore::yes);
  CHECK_FALSE(std::filesystem::exists(directory / "a.db.before-v1"));
  migrate(database, first_steps(3), CopyBefore::yes);
  Database copy(directory / "a.db.before-v3", Database::Access::read_only);
  CHECK(copy.find<int>("PRAGMA user_version") == 1);
  CHECK(copy.find<int>("SELECT x FROM a") == 7);
}

TEST_CASE("a step that fails leaves the version before it, whole") {
  constexpr std::array<std::string_view, 2> kBroken{kSteps[0], "UPDATE a SET x = 9; CREATE TABLE a (x INTEGER)"};
  const TempDir directory;
  Database database(directory / "a.db", Database::Access::create);
  const Migrations broken{.application_id = 77, .page_bytes = 4096, .steps = kBroken};
  CHECK_THROWS_AS(migrate(database, broken, CopyBefore::yes), StorageError);
  CHECK(database.find<int>("PRAGMA user_version") == 1);
  CHECK(database.find<int>("SELECT x FROM a") == 7);
}

TEST_CASE("a version that is newer than the program is refused and left alone") {
  const TempDir directory;
  { Store store(options_for(directory.path())); }
  {
    Database database(directory / "raywatch.db", Database::Access::read_write);
    database.run("PRAGMA user_version = 99");
  }
  try {
    Store store(options_for(directory.path()));
    FAIL("it was opened");
  } catch (const StorageError& error) {
    CHECK(std::string(error.what()).find("version 99") != std::string::npos);
  }
  Database database(directory / "raywatch.db", Database::Access::read_only);
  CHECK(database.find<int>("PRAGMA user_version") == 99);
}

TEST_CASE("a database of another program is refused and left alone") {
  const TempDir directory;
  Database database(directory / "raywatch.db", Database::Access::create);
  database.run_script("CREATE TABLE theirs (x INTEGER)");
  CHECK_THROWS_AS(Store(options_for(directory.path())), StorageError);
  CHECK(database.find<int>("SELECT count(*) FROM sqlite_schema") == 1);
}

}  // namespace
}  // namespace raywatch
