#pragma once

#include <vector>

#include "storage/payloads.hpp"

namespace raywatch {

/// Payloads that were written and that no committed record refers to yet: they are removed again unless they are kept.
class UnownedPayloads {
 public:
  explicit UnownedPayloads(Payloads& payloads) : payloads_(payloads) {}
  UnownedPayloads(const UnownedPayloads&) = delete;
  UnownedPayloads& operator=(const UnownedPayloads&) = delete;
  ~UnownedPayloads();

  PayloadRef add(PayloadRef ref) {
    refs_.push_back(ref);
    return ref;
  }
  /// The records are committed.
  void keep() { refs_.clear(); }

 private:
  Payloads& payloads_;
  std::vector<PayloadRef> refs_;
};

}  // namespace raywatch
