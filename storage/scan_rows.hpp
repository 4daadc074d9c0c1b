#pragma once

#include <string>

#include "storage/scans.hpp"
#include "storage/sqlite.hpp"

namespace raywatch {

/// "SELECT <all columns> FROM scans ", and what reads one such row.
const std::string& select_scans();
ScanRecord read_scan(Statement& row);

}  // namespace raywatch
