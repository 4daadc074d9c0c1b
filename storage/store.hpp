#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/time.hpp"

namespace raywatch {

class Payloads;
struct PayloadRef;
class Signal;
struct OpenReport;

/// A read-only view of the metadata at one moment: everything read through one snapshot is consistent. Used by the
/// functions of the record headers (`sites.hpp`, `scans.hpp`, ...). Not thread-safe; lives only inside `Store::read`.
class Snapshot {
 public:
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  struct Impl;
  Impl& impl() const { return *impl_; }

 protected:
  explicit Snapshot(Impl& impl) : impl_(&impl) {}
  ~Snapshot() = default;
  friend class Store;

 private:
  Impl* impl_;
};

/// A change of the metadata in progress, on the writer thread. It can read what it wrote.
class Transaction : public Snapshot {
 private:
  using Snapshot::Snapshot;
  friend class Store;
};

struct StoreOptions {
  std::filesystem::path data_dir;  ///< created when missing
  unsigned readers = 4;            ///< read-only connections
  /// Below this much free disk nothing new is stored (`DiskFull`); deletions, edits and the ends of jobs that failed
  /// may use it up.
  std::uint64_t min_free_bytes = 256u << 20;
};

/// The store: `raywatch.db` with all metadata, and payload files with points and point classes.
///
/// Thread-safe. One thread owns every writing connection and does every commit and checkpoint; readers have their own
/// read-only connections. A lock file keeps a second process out. When `write` returns, the change is on the disk.
class Store {
 public:
  /// Opens or creates the store: takes the lock, refuses a schema that is newer than this program's, copies the
  /// metadata before migrating an older one, checks it after an unclean stop, and sweeps payloads without an owner.
  /// @throws StorageError, CorruptData, DiskFull.
  explicit Store(const StoreOptions& options);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// Runs `f(const Snapshot&)` on a read-only connection and returns its result. Blocks while all are in use.
  template <class F>
  auto read(F&& f) const -> std::invoke_result_t<F, const Snapshot&> {
    using Result = std::invoke_result_t<F, const Snapshot&>;
    if constexpr (std::is_void_v<Result>) {
      read_erased([&](const Snapshot& snapshot) { f(snapshot); });
    } else {
      std::optional<Result> result;
      read_erased([&](const Snapshot& snapshot) { result.emplace(f(snapshot)); });
      return std::move(*result);
    }
  }

  /// Runs `f(Transaction&)` on the writer thread inside one transaction and returns its result after the commit is
  /// durable. An exception of `f` rolls back and comes out here. `f` must not call the store.
  template <class F>
  auto write(F&& f) -> std::invoke_result_t<F, Transaction&> {
    using Result = std::invoke_result_t<F, Transaction&>;
    if constexpr (std::is_void_v<Result>) {
      write_erased([&](Transaction& transaction) { f(transaction); });
    } else {
      std::optional<Result> result;
      write_erased([&](Transaction& transaction) { result.emplace(f(transaction)); });
      return std::move(*result);
    }
  }

  /// Says after each commit of the metadata that there was one.
  Signal& commits();

  /// Points and point classes. Put there first, then committed to the metadata by reference.
  Payloads& payloads();

  /// Gives space that deletions freed back to the disk: of the payload files in which these payloads were, and a
  /// bounded part of that of the metadata. What somebody still reads is left for a later call.
  void give_back_space(const std::vector<PayloadRef>& deleted);

  /// @throws DiskFull when so much more would leave less free than is kept.
  void require_room(std::uint64_t bytes) const;
  std::uint64_t reserve_bytes() const;

  /// Copies the running store consistently into `directory`, which must not exist or be empty. Writing goes on
  /// meanwhile.
  /// @throws InvalidInput for an unusable directory; StorageError, DiskFull.
  void backup(const std::filesystem::path& directory);

  const std::filesystem::path& data_dir() const;
  bool recovered_from_unclean_stop() const;
  /// What was found and cleared away at the opening; `storage/sweep.hpp` has the struct.
  const OpenReport& open_report() const;

 private:
  void read_erased(const std::function<void(const Snapshot&)>& f) const;
  void write_erased(const std::function<void(Transaction&)>& f);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace raywatch
