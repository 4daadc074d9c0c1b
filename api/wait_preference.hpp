#pragma once

#include <chrono>
#include <optional>
#include <span>

#include "api/call.hpp"
#include "core/ids.hpp"

namespace raywatch {

/// How long a client wants to wait for comparisons, by `Prefer: wait=N` (RFC 7240), at most as long as is configured. A
/// preference that is not understood is ignored, as that says.
std::optional<std::chrono::seconds> preferred_wait(const Call& call);

/// Waits until all comparisons of the scans ended, the time is over, or nobody waits for the answer any more.
void wait_for_scans(const Call& call, std::span<const ScanId> scans, std::chrono::seconds time);

/// Says in the answer that the preference was followed.
void set_wait_applied(HttpAnswer& answer, std::chrono::seconds time);

}  // namespace raywatch
