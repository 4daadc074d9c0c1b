#include "storage/store.hpp"

#include <set>

#include "storage/backup.hpp"
#include "storage/data_dir.hpp"
#include "storage/migrations.hpp"
#include "storage/payloads_impl.hpp"
#include "storage/reader_pool.hpp"
#include "storage/signal.hpp"
#include "storage/snapshot.hpp"
#include "storage/sweep.hpp"
#include "storage/writer_thread.hpp"

namespace raywatch {
namespace {

constexpr const char* kMetadataFile = "raywatch.db";

std::filesystem::path made(const std::filesystem::path& data_dir) {
  if (data_dir.empty()) throw StorageError("no data directory is given");
  const std::filesystem::path absolute = std::filesystem::absolute(data_dir).lexically_normal();
  make_directories_durably(absolute);
  return absolute;
}

/// Payloads without metadata are no new store: opening one would sweep them all.
void require_metadata_beside_payloads(const PayloadFiles& files) {
  if (std::filesystem::exists(files.data_dir() / kMetadataFile) || files.on_disk().empty()) return;
  throw StorageError(files.data_dir().string() + " has payload files but no " + kMetadataFile +
                     ": put the metadata back from a backup, or give another data directory");
}

void require_sound(Database& metadata) {
  const auto verdict = metadata.find<std::string>("PRAGMA quick_check(1)");
  if (verdict != "ok") {
    throw CorruptData(metadata.file().string() + " is damaged (" + verdict.value_or("no answer") +
                      "): restore the data directory from a backup");
  }
}

}  // namespace

struct Store::Impl {
  explicit Impl(const StoreOptions& options);

  void open();
  void open_files();
  void close() noexcept;

  StoreOptions options;
  std::filesystem::path data_dir;
  DataDirLock lock;
  RunningMarker marker;
  PayloadFiles files;
  OpenReport report;
  std::unique_ptr<Database> metadata;  // the writing connection: only on the writer thread
  Signal committed;
  WriterThread writer;
  std::unique_ptr<ReaderPool> readers;
  Payloads payloads;
};

Store::Impl::Impl(const StoreOptions& options_)
    : options(options_),
      data_dir(made(options_.data_dir)),
      lock(data_dir),
      marker(data_dir),
      files(data_dir),
      payloads(std::make_unique<Payloads::Impl>(files, writer, options_.min_free_bytes)) {}

/// On the writer thread.
void Store::Impl::open() {
  require_metadata_beside_payloads(files);
  report.unclean_stop = marker.found();
  marker.set();
  try {
    open_files();
  } catch (...) {
    // A refusal is no unclean stop; after one, the check is still due.
    if (!report.unclean_stop) close();
    throw;
  }
}

void Store::Impl::open_files() {
  metadata = std::make_unique<Database>(data_dir / kMetadataFile, Database::Access::create);
  if (report.unclean_stop) require_sound(*metadata);
  migrate(*metadata, metadata_migrations(), CopyBefore::yes);
  metadata->run_script("PRAGMA journal_size_limit = 67108864");
  sweep_payloads(*metadata, files, report);
  sweep_spool(data_dir, report);
}

/// On the writer thread, when nobody reads any more.
void Store::Impl::close() noexcept {
  try {
    files.close();
    metadata.reset();
    marker.remove();
  } catch (...) {
    // The marker stays: the next start checks the metadata.
  }
}

Store::Store(const StoreOptions& options) : impl_(std::make_unique<Impl>(options)) {
  impl_->writer.run([this] { impl_->open(); });
  impl_->readers = std::make_unique<ReaderPool>(impl_->data_dir / kMetadataFile, options.readers);
}

Store::~Store() {
  impl_->readers.reset();
  impl_->writer.run([this] { impl_->close(); });
}

void Store::read_erased(const std::function<void(const Snapshot&)>& f) const {
  impl_->readers->read([&](Database& database) {
    Snapshot::Impl view{database, impl_->data_dir, impl_->options.min_free_bytes};
    f(Snapshot(view));
  });
}

void Store::write_erased(const std::function<void(Transaction&)>& f) {
  impl_->writer.run([&] {
    Database& database = *impl_->metadata;
    Snapshot::Impl view{database, impl_->data_dir, impl_->options.min_free_bytes};
    database.transact([&] {
      Transaction transaction(view);
      f(transaction);
    });
  });
  impl_->committed.notify();
}

Signal& Store::commits() { return impl_->committed; }

Payloads& Store::payloads() { return impl_->payloads; }

void Store::give_back_space(const std::vector<PayloadRef>& deleted) {
  constexpr std::string_view kSomePages = "PRAGMA incremental_vacuum(256)";
  std::set<std::string> files;
  for (const PayloadRef& payload : deleted) {
    if (payload.file.empty() || !std::filesystem::exists(impl_->data_dir / payload.file)) continue;
    files.insert(payload.file);
  }
  for (const std::string& file : files) impl_->writer.run([&] { impl_->files.writer(file).checkpoint(); });
  impl_->writer.run([&] {
    impl_->metadata->run(kSomePages);
    impl_->metadata->checkpoint();
  });
}

void Store::require_room(std::uint64_t bytes) const {
  raywatch::require_room(impl_->data_dir, {.bytes = bytes, .reserve_bytes = impl_->options.min_free_bytes});
}

std::uint64_t Store::reserve_bytes() const { return impl_->options.min_free_bytes; }

void Store::backup(const std::filesystem::path& directory) {
  const DeletionHold hold(impl_->payloads.impl());
  impl_->readers->read(
      [&](Database& metadata) { copy_store(metadata, impl_->files, directory, impl_->options.min_free_bytes); });
}

const std::filesystem::path& Store::data_dir() const { return impl_->data_dir; }
bool Store::recovered_from_unclean_stop() const { return impl_->report.unclean_stop; }
const OpenReport& Store::open_report() const { return impl_->report; }

}  // namespace raywatch
