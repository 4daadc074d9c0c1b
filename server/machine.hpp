#pragma once

#include <cstdint>
#include <filesystem>

namespace raywatch {

/// Memory of this process that is in RAM; 0 when the system does not say.
std::uint64_t resident_memory_bytes();

/// What this process may still write to the disk of `directory`; 0 when the system does not say.
std::uint64_t free_disk_bytes(const std::filesystem::path& directory);

/// True if files can be made in `directory`.
bool is_writable(const std::filesystem::path& directory);

/// The directory in which the running program lies; empty when the system does not say.
std::filesystem::path program_dir();

}  // namespace raywatch
