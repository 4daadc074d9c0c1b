#include "storage/payload_rows.hpp"

#include "core/error.hpp"

namespace raywatch {
namespace {

void insert_chunks(Database& database, std::int64_t payload, const std::vector<EncodedChunk>& chunks) {
  std::int64_t id = payload * kChunksPerPayload;
  for (const EncodedChunk& chunk : chunks) {
    Statement row(database, "INSERT INTO chunks VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
    row.bind(id++);
    for (const auto member :
         {&ChunkBounds::azimuth_min_rad, &ChunkBounds::azimuth_max_rad, &ChunkBounds::elevation_min_rad,
          &ChunkBounds::elevation_max_rad, &ChunkBounds::range_min_m, &ChunkBounds::range_max_m}) {
      row.bind(chunk.bounds ? std::optional((*chunk.bounds).*member) : std::nullopt);
    }
    row.bind(chunk.data).next();
  }
}

ChunkBounds take_bounds(Statement& row) {
  ChunkBounds bounds;
  for (const auto member :
       {&ChunkBounds::azimuth_min_rad, &ChunkBounds::azimuth_max_rad, &ChunkBounds::elevation_min_rad,
        &ChunkBounds::elevation_max_rad, &ChunkBounds::range_min_m, &ChunkBounds::range_max_m}) {
    bounds.*member = row.take<double>();
  }
  return bounds;
}

}  // namespace

std::int64_t insert_payload(Database& database, const EncodedPayload& payload) {
  database.run(
      "INSERT INTO payloads (kind, points, chunks, has_intensity, grid_rows, grid_columns, prior_points, stored_bytes) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
      payload.kind, payload.points, payload.chunks.size(), payload.has_intensity,
      payload.grid ? std::optional(payload.grid->rows) : std::nullopt,
      payload.grid ? std::optional(payload.grid->columns) : std::nullopt, payload.prior_points, payload.bytes());
  const std::int64_t key = database.last_id();
  if (!payload.panorama.empty()) database.run("INSERT INTO panoramas VALUES (?, ?)", key, payload.panorama);
  insert_chunks(database, key, payload.chunks);
  return key;
}

[[noreturn]] void throw_missing(const PayloadRef& ref) {
  throw NotFound("there is no payload " + std::to_string(ref.key) + " in " + ref.file);
}

PayloadRow payload_row(Database& database, const PayloadRef& ref) {
  Statement row(database,
                "SELECT kind, points, chunks, has_intensity, grid_rows, grid_columns, prior_points, stored_bytes "
                "FROM payloads WHERE id = ?");
  if (!row.bind(ref.key).next()) throw_missing(ref);
  PayloadRow payload;
  payload.kind = row.take<std::string>();
  payload.points = row.take<std::uint64_t>();
  payload.chunks = row.take<std::int64_t>();
  payload.has_intensity = row.take<bool>();
  const auto rows = row.take<std::optional<std::uint32_t>>();
  const auto columns = row.take<std::optional<std::uint32_t>>();
  if (rows && columns) payload.grid = ShotGrid{*rows, *columns};
  payload.prior_points = row.take<std::uint64_t>();
  payload.stored_bytes = row.take<std::uint64_t>();
  return payload;
}

std::vector<std::int64_t> chunks_that_meet(Database& database, const PayloadRef& ref, const DirectionCone& cone) {
  // The band of elevations leaves few rows to be looked at more closely.
  const ElevationBand band = elevation_band(cone);
  Statement rows(database,
                 "SELECT id, azimuth_min_rad, azimuth_max_rad, elevation_min_rad, elevation_max_rad, range_min_m, "
                 "range_max_m FROM chunks INDEXED BY chunk_bounds WHERE id >= ? AND id < ? AND azimuth_min_rad IS NOT "
                 "NULL AND elevation_max_rad >= ? AND elevation_min_rad <= ? ORDER BY id");
  rows.bind(ref.key * kChunksPerPayload, (ref.key + 1) * kChunksPerPayload, band.min_rad, band.max_rad);
  std::vector<std::int64_t> ids;
  while (rows.next()) {
    const auto id = rows.take<std::int64_t>();
    if (may_meet(take_bounds(rows), cone)) ids.push_back(id);
  }
  return ids;
}

void delete_payloads(PayloadFiles& files, const std::string& file, std::span<const std::int64_t> keys) {
  Database& database = files.writer(file);
  database.transact([&] {
    for (const std::int64_t key : keys) {
      database.run("DELETE FROM chunks WHERE id >= ? AND id < ?", key * kChunksPerPayload,
                   (key + 1) * kChunksPerPayload);
      database.run("DELETE FROM panoramas WHERE payload = ?", key);
      database.run("DELETE FROM payloads WHERE id = ?", key);
    }
  });
  database.run("PRAGMA incremental_vacuum");
}

}  // namespace raywatch
