#pragma once

namespace raywatch {

/// The version of this program, such as "1.2.3".
const char* program_version();

}  // namespace raywatch
