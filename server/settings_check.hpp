#pragma once

#include <vector>

#include "core/error.hpp"
#include "server/daemon.hpp"

namespace raywatch {

/// What would keep a daemon from starting, or from doing what its settings promise, although each setting by itself is
/// of the right kind. The fields are the keys of the configuration file. Reads what settings name on this machine's
/// disk.
std::vector<FieldError> complaints_about(const DaemonConfig& config);

}  // namespace raywatch
