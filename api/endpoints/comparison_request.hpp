#pragma once

// Internal: only .cpp files of api/ include this.
#include <nlohmann/json.hpp>

#include "core/compare.hpp"
#include "storage/comparisons.hpp"

namespace raywatch::endpoints {

/// What `POST /comparisons` asks for.
struct ComparisonRequest {
  ScanId scan;
  Reference reference;
  CompareParameters parameters;  ///< what is not given follows from the profile of the scan's site
};

/// @throws InvalidInput naming the members; NotFound for scans that do not exist.
ComparisonRequest parse_comparison_request(const Snapshot& snapshot, const nlohmann::json& json);

}  // namespace raywatch::endpoints
