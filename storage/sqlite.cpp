#include "storage/sqlite.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace raywatch {
namespace {

constexpr int kBusyTimeout_ms = 10'000;

/// SQLite itself only knows ENOSPC as a full disk; a used-up quota and a limit of the file's size come as I/O errors.
/// `errno` was cleared before the call that failed.
bool was_out_of_space(sqlite3* handle) {
  const auto is_space_error = [](int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; };
  const int last = errno;
  return is_space_error(last) || (handle && is_space_error(sqlite3_system_errno(handle)));
}

[[noreturn]] void throw_failure(sqlite3* handle, int code, const std::filesystem::path& file, std::string_view doing) {
  const bool out_of_space = was_out_of_space(handle);
  const char* why = handle ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
  const std::string message = file.string() + ": " + std::string(doing) + ": " + why;
  const int primary = code & 0xff;
  if (primary == SQLITE_FULL || (primary == SQLITE_IOERR && out_of_space)) throw DiskFull(message);
  if (primary == SQLITE_CORRUPT || primary == SQLITE_NOTADB) throw CorruptData(message);
  throw StorageError(message);
}

int open_flags(Database::Access access) {
  switch (access) {
    case Database::Access::read_only:
      return SQLITE_OPEN_READONLY;
    case Database::Access::read_write:
      return SQLITE_OPEN_READWRITE;
    case Database::Access::create:
      break;
  }
  return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
}

}  // namespace

Statement::Statement(Database& database, std::string_view sql)
    : database_(database), sql_(sql), handle_(database.borrow(sql_)) {}

Statement::~Statement() { database_.give_back(sql_, handle_); }

bool Statement::next() {
  column_ = 0;
  errno = 0;
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.fail(code, "cannot run a statement");
  return false;
}

void Statement::bind_null() { sqlite3_bind_null(handle_, ++parameter_); }
void Statement::bind_integer(std::int64_t value) { sqlite3_bind_int64(handle_, ++parameter_, value); }
void Statement::bind_real(double value) { sqlite3_bind_double(handle_, ++parameter_, value); }

void Statement::bind_text(std::string_view value) {
  const int code = sqlite3_bind_text64(handle_, ++parameter_, value.data() ? value.data() : "", value.size(),
                                       SQLITE_TRANSIENT, SQLITE_UTF8);
  if (code != SQLITE_OK) database_.fail(code, "cannot bind a text");
}

void Statement::bind_blob(std::span<const std::uint8_t> value) {
  const int code = value.empty()
                       ? sqlite3_bind_zeroblob(handle_, ++parameter_, 0)
                       : sqlite3_bind_blob64(handle_, ++parameter_, value.data(), value.size(), SQLITE_STATIC);
  if (code != SQLITE_OK) database_.fail(code, "cannot bind a blob");
}

bool Statement::next_is_null() const { return sqlite3_column_type(handle_, column_) == SQLITE_NULL; }
std::int64_t Statement::take_integer() { return sqlite3_column_int64(handle_, column_++); }
double Statement::take_real() { return sqlite3_column_double(handle_, column_++); }

std::string Statement::take_text() {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column_));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_, column_++));
  return text ? std::string(text, size) : std::string();
}

std::span<const std::uint8_t> Statement::take_blob() {
  const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(handle_, column_));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_, column_++));
  if (!bytes && size > 0) database_.fail(SQLITE_NOMEM, "cannot read a blob");
  return {bytes, size};
}

Database::Database(const std::filesystem::path& file, Access access) : file_(file) {
  errno = 0;
  const int code = sqlite3_open_v2(file.c_str(), &handle_, open_flags(access) | SQLITE_OPEN_NOMUTEX, nullptr);
  if (code != SQLITE_OK) {
    const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> failed(std::exchange(handle_, nullptr), &sqlite3_close);
    throw_failure(failed.get(), code, file_, "cannot open");
  }
  sqlite3_extended_result_codes(handle_, 1);
  sqlite3_busy_timeout(handle_, kBusyTimeout_ms);
  try {
    run_script(access == Access::read_only ? "PRAGMA query_only = ON"
                                           : "PRAGMA foreign_keys = ON; PRAGMA synchronous = FULL");
  } catch (...) {
    sqlite3_close(handle_);  // the destructor of an object that was never made does not run
    throw;
  }
}

Database::~Database() {
  for (auto& [sql, statements] : idle_) {
    for (sqlite3_stmt* statement : statements) sqlite3_finalize(statement);
  }
  sqlite3_close(handle_);
}

void Database::fail(int code, std::string_view doing) const { throw_failure(handle_, code, file_, doing); }

sqlite3_stmt* Database::borrow(const std::string& sql) {
  std::vector<sqlite3_stmt*>& idle = idle_[sql];
  if (!idle.empty()) {
    sqlite3_stmt* statement = idle.back();
    idle.pop_back();
    return statement;
  }
  sqlite3_stmt* statement = nullptr;
  errno = 0;
  const int code = sqlite3_prepare_v3(handle_, sql.c_str(), static_cast<int>(sql.size()) + 1, SQLITE_PREPARE_PERSISTENT,
                                      &statement, nullptr);
  if (code != SQLITE_OK) fail(code, "cannot prepare \"" + sql + "\"");
  return statement;
}

void Database::give_back(const std::string& sql, sqlite3_stmt* statement) noexcept {
  sqlite3_reset(statement);
  sqlite3_clear_bindings(statement);
  try {
    idle_[sql].push_back(statement);
  } catch (...) {
    sqlite3_finalize(statement);
  }
}

void Database::run_script(const std::string& sql) {
  errno = 0;
  const int code = sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code, "cannot run a script");
}

void Database::rollback() noexcept {
  // After some failures, such as a full disk, SQLite has rolled back by itself.
  if (!sqlite3_get_autocommit(handle_)) sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
}

void Database::run_between(std::string_view begin, const std::function<void()>& f) {
  run(begin);
  try {
    f();
    run("COMMIT");
  } catch (...) {
    rollback();
    throw;
  }
}

void Database::transact(const std::function<void()>& f) { run_between("BEGIN IMMEDIATE", f); }
void Database::read_consistently(const std::function<void()>& f) { run_between("BEGIN", f); }

std::uint64_t Database::bytes_in_use() {
  const auto pages = find<std::uint64_t>("PRAGMA page_count").value_or(0);
  const auto free_pages = find<std::uint64_t>("PRAGMA freelist_count").value_or(0);
  return (pages - std::min(free_pages, pages)) * find<std::uint64_t>("PRAGMA page_size").value_or(0);
}

void Database::checkpoint() {
  // A reader that holds a part of the log back would be waited for.
  sqlite3_busy_timeout(handle_, 0);
  try {
    run("PRAGMA wal_checkpoint(TRUNCATE)");
  } catch (...) {
    sqlite3_busy_timeout(handle_, kBusyTimeout_ms);
    throw;
  }
  sqlite3_busy_timeout(handle_, kBusyTimeout_ms);
}

std::int64_t Database::last_id() const { return sqlite3_last_insert_rowid(handle_); }
std::int64_t Database::changed_rows() const { return sqlite3_changes64(handle_); }

std::vector<std::string> Database::cached_statements() const {
  std::vector<std::string> texts;
  for (const auto& [sql, statements] : idle_) texts.push_back(sql);
  return texts;
}

void Database::copy_to(const std::filesystem::path& target) {
  Database copy(target, Access::create);
  sqlite3_backup* backup = sqlite3_backup_init(copy.handle_, "main", handle_, "main");
  if (!backup) copy.fail(sqlite3_errcode(copy.handle_), "cannot start a copy");
  errno = 0;
  // One step over all pages holds one read lock: the copy is of one moment, and writing goes on meanwhile.
  sqlite3_backup_step(backup, -1);
  const int code = sqlite3_backup_finish(backup);
  if (code != SQLITE_OK) copy.fail(code, "cannot copy " + file_.string());
}

}  // namespace raywatch
