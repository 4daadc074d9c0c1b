#include "storage/sqlite.hpp"

#include <doctest/doctest.h>

#include <array>
#include <fstream>
#include <stdexcept>

#include "tests/support/temp_dir.hpp"

namespace raywatch {
namespace {

std::int64_t rows_of(Database& database) { return database.find<std::int64_t>("SELECT count(*) FROM t").value(); }

TEST_CASE("a database gives back the values that it was given") {
  const TempDir directory;
  Database database(directory / "a.db", Database::Access::create);
  database.run_script("CREATE TABLE t (i INTEGER, r REAL, s TEXT, b BLOB, n INTEGER) STRICT");
  const std::array<std::uint8_t, 3> blob{1, 0, 255};
  database.run("INSERT INTO t VALUES (?, ?, ?, ?, ?)", INT64_MIN, 0.1, std::string("a\0b", 3), blob,
               std::optional<std::int64_t>());
  Statement row(database, "SELECT i, r, s, b, n FROM t");
  REQUIRE(row.next());
  CHECK(row.take<std::int64_t>() == INT64_MIN);
  CHECK(row.take<double>() == 0.1);
  CHECK(row.take<std::string>() == std::string("a\0b", 3));
  const auto bytes = row.take<std::span<const std::uint8_t>>();
  CHECK(std::vector(bytes.begin(), bytes.end()) == std::vector(blob.begin(), blob.end()));
  CHECK_FALSE(row.take<std::optional<std::int64_t>>().has_value());
  CHECK_FALSE(row.next());
}

TEST_CASE("a transaction that throws leaves nothing behind") {
  const TempDir directory;
  Database database(directory / "a.db", Database::Access::create);
  database.run_script("CREATE TABLE t (i INTEGER) STRICT");
  const auto insert_and_throw = [&] {
    database.run("INSERT INTO t VALUES (1)");
    throw std::runtime_error("no");
  };
  CHECK_THROWS_AS(database.transact(insert_and_throw), std::runtime_error);
  CHECK(rows_of(database) == 0);
  database.transact([&] { database.run("INSERT INTO t VALUES (1)"); });
  CHECK(rows_of(database) == 1);
}

TEST_CASE("a full database is reported as a full disk, and goes on when there is room again") {
  const TempDir directory;
  Database database(directory / "a.db", Database::Access::create);
  database.run_script("CREATE TABLE t (b BLOB) STRICT");
  const std::vector<std::uint8_t> large(100'000, 7);
  database.run("PRAGMA max_page_count = 5");
  CHECK_THROWS_AS(database.transact([&] { database.run("INSERT INTO t VALUES (?)", large); }), DiskFull);
  CHECK(rows_of(database) == 0);
  database.run("PRAGMA max_page_count = 1000");
  database.transact([&] { database.run("INSERT INTO t VALUES (?)", large); });
  CHECK(rows_of(database) == 1);
}

TEST_CASE("a file that is no database is reported as corrupt") {
  const TempDir directory;
  std::ofstream(directory / "a.db") << std::string(5000, 'x');
  const auto read = [&] {
    Database database(directory / "a.db", Database::Access::read_write);
    database.find<std::int64_t>("SELECT count(*) FROM sqlite_schema");
  };
  CHECK_THROWS_AS(read(), CorruptData);
}

TEST_CASE("a read-only connection refuses to write") {
  const TempDir directory;
  Database writer(directory / "a.db", Database::Access::create);
  writer.run_script("CREATE TABLE t (i INTEGER) STRICT");
  Database reader(directory / "a.db", Database::Access::read_only);
  CHECK_THROWS_AS(reader.run("INSERT INTO t VALUES (1)"), StorageError);
}

TEST_CASE("a statement can be used again while it is in use") {
  const TempDir directory;
  Database database(directory / "a.db", Database::Access::create);
  Statement outer(database, "SELECT value FROM (SELECT 1 AS value UNION SELECT 2) ORDER BY value");
  REQUIRE(outer.next());
  Statement inner(database, "SELECT value FROM (SELECT 1 AS value UNION SELECT 2) ORDER BY value");
  REQUIRE(inner.next());
  CHECK(inner.take<int>() == 1);
  REQUIRE(outer.next());
  CHECK(outer.take<int>() == 1 + 1);
}

}  // namespace
}  // namespace raywatch
