#include "storage/payloads.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <utility>

#include "core/error.hpp"
#include "storage/chunk_codec.hpp"
#include "storage/class_codec.hpp"
#include "storage/data_dir.hpp"
#include "storage/payload_rows.hpp"
#include "storage/payloads_impl.hpp"
#include "storage/survey_codec.hpp"
#include "storage/surveys.hpp"

namespace raywatch {
namespace {

/// Memory is taken for at most so many points before any of them was read.
constexpr std::size_t kTrustedPoints = std::size_t{1} << 20;

std::vector<EncodedChunk> encode_chunks(const PointCloud& points) {
  BlockSealer sealer;
  std::vector<EncodedChunk> chunks;
  for (std::size_t first = 0; first < points.size(); first += kChunkPoints) {
    const std::size_t count = std::min(kChunkPoints, points.size() - first);
    const auto part = [&](const std::vector<float>& plane) { return std::span(plane).subspan(first, count); };
    chunks.push_back({chunk_bounds(part(points.x_m), part(points.y_m), part(points.z_m)),
                      encode_chunk(points, first, count, sealer)});
  }
  return chunks;
}

void require_one_length(const PointCloud& points) {
  const std::size_t size = points.size();
  const bool intensity_fits = points.intensity.empty() || points.intensity.size() == size;
  const bool grid_fits = !points.grid || std::uint64_t{points.grid->rows} * points.grid->columns == size;
  if (points.y_m.size() != size || points.z_m.size() != size || !intensity_fits || !grid_fits) {
    throw InvalidInput("the planes of a scan have different lengths");
  }
  if (size > kChunkPoints * static_cast<std::size_t>(kChunksPerPayload)) throw TooLarge("the scan has too many points");
}

/// Where a payload is put, and how far the search for a sound file of its month goes.
struct PayloadPlace {
  SiteId site;
  Time captured_at;
};
constexpr int kMaxParts = 100;

/// Writes into the first part of the month that is not damaged. On the writer thread.
PayloadRef put_into_sound_file(Payloads::Impl& impl, const PayloadPlace& place, const EncodedPayload& payload) {
  for (int part = 1;; ++part) {
    const std::string file = payload_file_name(place.site, place.captured_at, part);
    if (impl.damaged.contains(file)) continue;
    try {
      Database& database = impl.files.writer(file);
      std::int64_t key = 0;
      database.transact([&] { key = insert_payload(database, payload); });
      return {file, key};
    } catch (const CorruptData&) {
      if (part == kMaxParts) throw;
      impl.damaged.insert(file);
    }
  }
}

PayloadRef put(Payloads::Impl& impl, const PayloadPlace& place, const EncodedPayload& payload) {
  PayloadRef ref;
  impl.writer.run([&] {
    require_room(impl.files.data_dir(), {.bytes = payload.bytes(), .reserve_bytes = impl.min_free_bytes});
    ref = put_into_sound_file(impl, place, payload);
  });
  return ref;
}

/// Calls `f(database, row)` for a payload, and names the payload in what is thrown about its bytes.
template <class F>
void read_payload(const Payloads::Impl& impl, const PayloadRef& ref, const F& f) {
  try {
    impl.files.read(ref.file, [&](Database* database) {
      if (!database) throw_missing(ref);
      f(*database, payload_row(*database, ref));
    });
  } catch (const CorruptData& error) {
    throw CorruptData("payload " + std::to_string(ref.key) + " in " + ref.file + ": " + error.what());
  }
}

/// Calls `f(place, data)` for the chunks of a payload, in order. Returns how many there are.
template <class F>
std::int64_t for_each_chunk(Database& database, const PayloadRef& ref, const F& f) {
  Statement rows(database, "SELECT id, data FROM chunks WHERE id >= ? AND id < ? ORDER BY id");
  rows.bind(ref.key * kChunksPerPayload, (ref.key + 1) * kChunksPerPayload);
  std::int64_t count = 0;
  for (; rows.next(); ++count) {
    const std::int64_t place = rows.take<std::int64_t>() - ref.key * kChunksPerPayload;
    if (place != count) throw CorruptData("a chunk is missing");
    f(rows.take<std::span<const std::uint8_t>>());
  }
  return count;
}

void require_kind(const PayloadRow& row, std::string_view kind) {
  if (row.kind != kind) throw NotFound("the payload is not of a " + std::string(kind));
}

void require_counts(const PayloadRow& row, std::int64_t chunks, std::uint64_t points) {
  if (chunks != row.chunks || points != row.points) throw CorruptData("chunks or points are missing");
}

void delete_if_there(PayloadFiles& files, const PayloadRef& ref) {
  if (ref.file.empty() || !std::filesystem::exists(files.data_dir() / ref.file)) return;
  delete_payloads(files, ref.file, std::array{ref.key});
}

}  // namespace

Payloads::Payloads(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Payloads::~Payloads() = default;
Payloads::Impl& Payloads::impl() { return *impl_; }

PayloadRef Payloads::put_scan(SiteId site, Time captured_at, const PointCloud& points, const Panorama& panorama) {
  require_one_length(points);
  const std::vector<std::uint8_t> panorama_bytes = to_bytes(panorama);
  EncodedPayload payload{.kind = "scan",
                         .points = points.size(),
                         .has_intensity = !points.intensity.empty(),
                         .grid = points.grid,
                         .panorama = BlockSealer().seal({.kind = BlockKind::panorama, .elements = 1}, panorama_bytes),
                         .chunks = encode_chunks(points)};
  return put(*impl_, {site, captured_at}, payload);
}

PointCloud Payloads::scan_points(const PayloadRef& ref) const {
  PointCloud points;
  read_payload(*impl_, ref, [&](Database& database, const PayloadRow& row) {
    require_kind(row, "scan");
    points.reserve(std::min<std::uint64_t>(row.points, kTrustedPoints));
    points.grid = row.grid;
    const std::int64_t chunks = for_each_chunk(
        database, ref, [&](std::span<const std::uint8_t> data) { decode_chunk(data, row.has_intensity, points); });
    require_counts(row, chunks, points.size());
  });
  return points;
}

std::vector<PointCloud> Payloads::scan_points_around(const PayloadRef& ref, const DirectionCone& cone) const {
  std::vector<PointCloud> chunks;
  read_payload(*impl_, ref, [&](Database& database, const PayloadRow& row) {
    require_kind(row, "scan");
    for (const std::int64_t id : chunks_that_meet(database, ref, cone)) {
      Statement chunk(database, "SELECT data FROM chunks WHERE id = ?");
      chunk.bind(id).next();
      decode_chunk(chunk.take<std::span<const std::uint8_t>>(), row.has_intensity, chunks.emplace_back());
    }
  });
  return chunks;
}

Panorama Payloads::scan_panorama(const PayloadRef& ref) const {
  Panorama panorama;
  read_payload(*impl_, ref, [&](Database& database, const PayloadRow& row) {
    require_kind(row, "scan");
    Statement blob(database, "SELECT data FROM panoramas WHERE payload = ?");
    if (!blob.bind(ref.key).next()) throw CorruptData("the panorama is missing");
    const auto data = blob.take<std::span<const std::uint8_t>>();
    open_block(data, BlockKind::panorama);
    constexpr std::size_t kPanorama_bytes = Panorama::kRows * Panorama::kColumns * sizeof(std::uint16_t);
    panorama = panorama_from_bytes(block_content(data, kPanorama_bytes));
  });
  return panorama;
}

std::uint64_t Payloads::stored_bytes(const PayloadRef& ref) const {
  std::uint64_t bytes = 0;
  read_payload(*impl_, ref, [&](Database&, const PayloadRow& row) { bytes = row.stored_bytes; });
  return bytes;
}

PayloadUse Payloads::use_of(SiteId site) const {
  PayloadUse use;
  for (const std::string& file : impl_->files.on_disk_of(site)) {
    std::error_code gone;
    const std::uintmax_t size = std::filesystem::file_size(impl_->files.data_dir() / file, gone);
    if (gone) continue;
    std::uint64_t in_use = size;
    try {
      impl_->files.read(file, [&](Database* database) { in_use = database ? database->bytes_in_use() : 0; });
    } catch (const CorruptData&) {
      // Nothing of a damaged file is given back.
    }
    use.in_use_bytes += in_use;
    use.freed_bytes += size - std::min<std::uint64_t>(in_use, size);
  }
  return use;
}

bool Payloads::deletions_wait() const {
  bool waits = false;
  impl_->writer.run([&] { waits = impl_->copies_running > 0; });
  return waits;
}

PayloadRef Payloads::put_comparison(SiteId site, Time captured_at, const ComparisonPoints& points) {
  EncodedPayload payload;
  payload.kind = "comparison";
  payload.points = points.classes.size();
  payload.prior_points = points.prior_points.size();
  for (std::vector<std::uint8_t>& block : encode_classes(points)) {
    payload.chunks.push_back({std::nullopt, std::move(block)});
  }
  return put(*impl_, {site, captured_at}, payload);
}

ComparisonPoints Payloads::comparison_points(const PayloadRef& ref) const {
  ComparisonPoints points;
  read_payload(*impl_, ref, [&](Database& database, const PayloadRow& row) {
    require_kind(row, "comparison");
    const std::int64_t chunks =
        for_each_chunk(database, ref, [&](std::span<const std::uint8_t> data) { decode_class_block(data, points); });
    require_counts(row, chunks, points.classes.size());
    if (points.prior_points.size() != row.prior_points) throw CorruptData("points of priors are missing");
  });
  return points;
}

void Payloads::remove(const PayloadRef& ref) {
  impl_->writer.run([&] {
    if (impl_->copies_running > 0) {
      impl_->held_back.push_back(ref);
    } else {
      delete_if_there(impl_->files, ref);
    }
  });
}

DeletionHold::DeletionHold(Payloads::Impl& payloads) : payloads_(payloads) {
  payloads_.writer.run([&] { ++payloads_.copies_running; });
}

DeletionHold::~DeletionHold() {
  payloads_.writer.run([&] {
    if (--payloads_.copies_running > 0) return;
    for (const PayloadRef& ref : std::exchange(payloads_.held_back, {})) {
      try {
        delete_if_there(payloads_.files, ref);
      } catch (const std::exception&) {
        // It has no owner any more: the next start sweeps it.
      }
    }
  });
}

PayloadRef put_survey(Payloads& payloads, SiteId site, Time captured_at, const SurveyResult& survey) {
  EncodedPayload payload;
  payload.kind = "survey";
  for (std::vector<std::uint8_t>& block : encode_models(survey)) {
    payload.chunks.push_back({std::nullopt, std::move(block)});
  }
  return put(payloads.impl(), {site, captured_at}, payload);
}

void read_models(Payloads& payloads, const PayloadRef& ref, SurveyResult& survey) {
  ModelDecoder decoder;
  read_payload(payloads.impl(), ref, [&](Database& database, const PayloadRow& row) {
    require_kind(row, "survey");
    const std::int64_t blocks =
        for_each_chunk(database, ref, [&](std::span<const std::uint8_t> block) { decoder.add(block); });
    if (blocks != row.chunks) throw CorruptData("blocks are missing");
    decoder.finish(survey);
  });
}

}  // namespace raywatch
