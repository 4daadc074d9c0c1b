#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/point_cloud.hpp"
#include "storage/chunk_codec.hpp"
#include "storage/payload_files.hpp"
#include "storage/payloads.hpp"
#include "storage/sqlite.hpp"

namespace raywatch {

// The rows of a payload file.

/// Chunk `place` of payload `key` has the id `key * kChunksPerPayload + place`.
inline constexpr std::int64_t kChunksPerPayload = std::int64_t{1} << 20;

struct EncodedChunk {
  std::optional<ChunkBounds> bounds;
  std::vector<std::uint8_t> data;
};

/// A payload as it is written: everything that costs time was done in the caller's thread.
struct EncodedPayload {
  std::string_view kind;
  std::uint64_t points = 0;
  std::uint64_t prior_points = 0;
  bool has_intensity = false;
  std::optional<ShotGrid> grid;
  std::vector<std::uint8_t> panorama;  ///< empty for comparisons
  std::vector<EncodedChunk> chunks;

  std::uint64_t bytes() const {
    std::uint64_t sum = panorama.size();
    for (const EncodedChunk& chunk : chunks) sum += chunk.data.size();
    return sum;
  }
};

/// A row of `payloads`.
struct PayloadRow {
  std::string kind;
  std::uint64_t points = 0;
  std::int64_t chunks = 0;
  bool has_intensity = false;
  std::optional<ShotGrid> grid;
  std::uint64_t prior_points = 0;
  std::uint64_t stored_bytes = 0;
};

/// Writes a payload and gives its key. Inside a transaction.
std::int64_t insert_payload(Database& database, const EncodedPayload& payload);

/// @throws NotFound when there is none.
PayloadRow payload_row(Database& database, const PayloadRef& ref);
[[noreturn]] void throw_missing(const PayloadRef& ref);

/// The ids of the chunks whose bounds meet a cone, in order.
std::vector<std::int64_t> chunks_that_meet(Database& database, const PayloadRef& ref, const DirectionCone& cone);

/// Deletes payloads of one file in one transaction. Only on the writer thread.
void delete_payloads(PayloadFiles& files, const std::string& file, std::span<const std::int64_t> keys);

}  // namespace raywatch
