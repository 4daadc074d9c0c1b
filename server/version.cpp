#include "server/version.hpp"

namespace raywatch {

const char* program_version() { return RAYWATCH_VERSION; }

}  // namespace raywatch
