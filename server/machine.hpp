#pragma once

#include <cstdint>
#include <filesystem>

namespace raywatch {

/// Memory of this process that is in RAM; 0 when the system does not say.
std::uint64_t resident_memory_bytes();

/// Has large blocks of memory go back to the system as soon as they are freed. By itself the allocator learns to keep
/// blocks of the size of a scan, whose different sizes then leave gaps: four times of what is in use after 1,000 scans.
void return_large_blocks();

/// What this process may still write to the disk of `directory`; 0 when the system does not say.
std::uint64_t free_disk_bytes(const std::filesystem::path& directory);

/// True if files can be made in `directory`.
bool is_writable(const std::filesystem::path& directory);

/// The directory in which the running program lies; empty when the system does not say.
std::filesystem::path program_dir();

}  // namespace raywatch
