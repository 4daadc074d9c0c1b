#pragma once

#include <set>
#include <string>
#include <vector>

#include "storage/payload_files.hpp"
#include "storage/payloads.hpp"
#include "storage/writer_thread.hpp"

namespace raywatch {

struct Payloads::Impl {
  Impl(PayloadFiles& files_, WriterThread& writer_, std::uint64_t min_free_bytes_)
      : files(files_), writer(writer_), min_free_bytes(min_free_bytes_) {}

  PayloadFiles& files;
  WriterThread& writer;
  std::uint64_t min_free_bytes;

  /// Damaged files, into which nothing more is written. Used on the writer thread only.
  std::set<std::string> damaged;
  /// While payloads are copied, deletions wait here. Used on the writer thread only.
  int copies_running = 0;
  std::vector<PayloadRef> held_back;
};

/// Keeps payloads from being deleted while it lives; what was asked for meanwhile is deleted at its end.
class DeletionHold {
 public:
  explicit DeletionHold(Payloads::Impl& payloads);
  ~DeletionHold();
  DeletionHold(const DeletionHold&) = delete;
  DeletionHold& operator=(const DeletionHold&) = delete;

 private:
  Payloads::Impl& payloads_;
};

}  // namespace raywatch
