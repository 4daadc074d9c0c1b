#pragma once

#include <cstdint>
#include <filesystem>

#include "storage/payload_files.hpp"

namespace raywatch {

/// Copies a store while it is written to: first the metadata as `metadata` sees it, then the payload files, which hold
/// all that the metadata refers to because payloads are committed first and the caller keeps them from being deleted.
/// What the copies have beyond that is swept when the copy is opened. The metadata gets its name last, so that an
/// unfinished copy is no store.
/// @throws InvalidInput when `directory` lies in the data directory, or exists and is not an empty directory;
///   StorageError; DiskFull.
void copy_store(Database& metadata, PayloadFiles& files, const std::filesystem::path& directory,
                std::uint64_t min_free_bytes);

}  // namespace raywatch
