#pragma once

#include <string_view>

#include "storage/comparisons.hpp"

namespace raywatch {

// Parts of `comparisons.hpp` that several sources of the store use.

void set_comparison_state(Transaction& transaction, ComparisonId id, ComparisonState state,
                          std::string_view failure = {});

/// Sets a scan's state after its comparisons: comparing while one runs, or others have ended and the watching one
/// waits; else compared if one is done, else queued if one waits, else failed.
void update_scan_state(Transaction& transaction, ScanId scan);

/// @returns their ids, in their order.
std::vector<ChangeId> insert_changes(Transaction& transaction, const ComparisonRecord& comparison,
                                     const std::vector<Change>& changes);

}  // namespace raywatch
