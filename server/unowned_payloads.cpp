#include "server/unowned_payloads.hpp"

#include <spdlog/spdlog.h>

#include "core/error.hpp"

namespace raywatch {

UnownedPayloads::~UnownedPayloads() {
  for (const PayloadRef& ref : refs_) {
    try {
      payloads_.remove(ref);
    } catch (const Error& error) {
      spdlog::warn("a payload without an owner stays until the next start: {}", error.what());
    }
  }
}

}  // namespace raywatch
