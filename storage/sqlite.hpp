#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/ids.hpp"
#include "core/time.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace raywatch {

class Database;

namespace sqlite_detail {
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsId : std::false_type {};
template <class Tag>
struct IsId<Id<Tag>> : std::true_type {};
}  // namespace sqlite_detail

/// A prepared statement on loan from its database's cache; it goes back, reset, when this ends. Not thread-safe.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Binds the next parameters in order. A blob is not copied: it must live until the last `next()`.
  template <class... Args>
  Statement& bind(const Args&... args) {
    (bind_value(args), ...);
    return *this;
  }

  /// Steps to the next row; false at the end.
  bool next();

  /// Reads the columns of the row from left to right. A blob is a view that lives until the next step.
  template <class T>
  T take() {
    return read<T>();
  }

 private:
  void bind_null();
  void bind_integer(std::int64_t value);
  void bind_real(double value);
  void bind_text(std::string_view value);
  void bind_blob(std::span<const std::uint8_t> value);
  bool next_is_null() const;
  std::int64_t take_integer();
  double take_real();
  std::string take_text();
  std::span<const std::uint8_t> take_blob();

  template <class T>
  void bind_value(const T& value) {
    if constexpr (sqlite_detail::IsOptional<T>::value) {
      value ? bind_value(*value) : bind_null();
    } else if constexpr (sqlite_detail::IsId<T>::value) {
      bind_integer(value.value);
    } else if constexpr (std::is_same_v<T, Time>) {
      bind_integer(value.time_since_epoch().count());
    } else if constexpr (std::is_same_v<T, Duration>) {
      bind_integer(value.count());
    } else if constexpr (std::is_integral_v<T>) {
      if (!std::is_same_v<T, bool> && !fits(value)) throw StorageError("a number is too large to be stored");
      bind_integer(static_cast<std::int64_t>(value));
    } else if constexpr (std::is_floating_point_v<T>) {
      bind_real(value);
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
      bind_text(value);
    } else {
      bind_blob(value);
    }
  }
  template <class T>
  static bool fits(T value) {
    return !(std::is_unsigned_v<T> && static_cast<std::uint64_t>(value) > static_cast<std::uint64_t>(INT64_MAX));
  }

  template <class T>
  T read() {
    if constexpr (sqlite_detail::IsOptional<T>::value) {
      if (next_is_null()) {
        ++column_;
        return std::nullopt;
      }
      return read<typename T::value_type>();
    } else if constexpr (sqlite_detail::IsId<T>::value) {
      return T{take_integer()};
    } else if constexpr (std::is_same_v<T, Time>) {
      return Time(Duration(take_integer()));
    } else if constexpr (std::is_same_v<T, Duration>) {
      return Duration(take_integer());
    } else if constexpr (std::is_same_v<T, bool>) {
      return take_integer() != 0;
    } else if constexpr (std::is_integral_v<T>) {
      return static_cast<T>(take_integer());
    } else if constexpr (std::is_floating_point_v<T>) {
      return take_real();
    } else if constexpr (std::is_same_v<T, std::string>) {
      return take_text();
    } else {
      return take_blob();
    }
  }

  Database& database_;
  std::string sql_;
  sqlite3_stmt* handle_ = nullptr;
  int parameter_ = 0;
  int column_ = 0;
};

/// One connection to one SQLite file. Failures come out as `DiskFull`, `CorruptData` or `StorageError`, with the file's
/// name. Not thread-safe: used by one thread at a time.
class Database {
 public:
  enum class Access { read_only, read_write, create };
  Database(const std::filesystem::path& file, Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Runs one statement to its end.
  template <class... Args>
  void run(std::string_view sql, const Args&... args) {
    Statement statement(*this, sql);
    statement.bind(args...);
    while (statement.next()) {
    }
  }
  /// The first column of the first row, if there is one.
  template <class T, class... Args>
  std::optional<T> find(std::string_view sql, const Args&... args) {
    Statement statement(*this, sql);
    statement.bind(args...);
    if (!statement.next()) return std::nullopt;
    return statement.take<T>();
  }
  /// Runs statements without parameters or results, separated by semicolons.
  void run_script(const std::string& sql);

  /// Runs `f` inside one transaction: committed when it returns, rolled back when it or the commit throws.
  void transact(const std::function<void()>& f);
  /// Runs `f` inside one read transaction, so that it sees one state of the file.
  void read_consistently(const std::function<void()>& f);

  /// The pages that hold something, in bytes.
  std::uint64_t bytes_in_use();
  /// Brings the log into the file, which loses what was freed at its end, and empties the log; as far as nobody reads
  /// what it holds. Never waits. Not inside a transaction.
  void checkpoint();

  std::int64_t last_id() const;
  std::int64_t changed_rows() const;
  /// The texts of the statements in the cache, for checks of their plans.
  std::vector<std::string> cached_statements() const;
  const std::filesystem::path& file() const { return file_; }

  /// Copies the state that this connection sees into a new file, and flushes it.
  void copy_to(const std::filesystem::path& target);

 private:
  friend class Statement;
  [[noreturn]] void fail(int code, std::string_view doing) const;
  void run_between(std::string_view begin, const std::function<void()>& f);
  void rollback() noexcept;
  sqlite3_stmt* borrow(const std::string& sql);
  void give_back(const std::string& sql, sqlite3_stmt* statement) noexcept;

  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
  std::unordered_map<std::string, std::vector<sqlite3_stmt*>> idle_;
};

}  // namespace raywatch
