#include "storage/sealed_block.hpp"

#include <zlib.h>
#include <zstd.h>

#include <cstring>
#include <new>
#include <string>

#include "core/error.hpp"

namespace raywatch {
namespace {

constexpr std::size_t kBlockHeader_bytes = 12;

std::uint32_t checksum(std::span<const std::uint8_t> block) {
  const std::span<const std::uint8_t> checked = block.subspan(sizeof(std::uint32_t));
  return static_cast<std::uint32_t>(crc32_z(0, checked.data(), checked.size()));
}

}  // namespace

BlockSealer::BlockSealer() : context_(ZSTD_createCCtx()) {
  if (!context_) throw std::bad_alloc();
  // Measured on two indoor scans of 12 bytes a point, shuffled: level 1 gives 8.8 and 4.4 bytes a point, level 3
  // saves 1.3 % of that at a third of the speed.
  ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, 1);
}

BlockSealer::~BlockSealer() = default;

void BlockSealer::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

std::vector<std::uint8_t> BlockSealer::seal(const BlockHeader& header, std::span<const std::uint8_t> content) {
  std::vector<std::uint8_t> block(kBlockHeader_bytes + ZSTD_compressBound(content.size()));
  block[4] = static_cast<std::uint8_t>(header.kind);
  block[5] = header.flags;
  std::memcpy(&block[8], &header.elements, sizeof header.elements);
  const std::size_t size = ZSTD_compress2(context_.get(), &block[kBlockHeader_bytes], block.size() - kBlockHeader_bytes,
                                          content.data(), content.size());
  if (ZSTD_isError(size)) throw StorageError(std::string("cannot compress: ") + ZSTD_getErrorName(size));
  block.resize(kBlockHeader_bytes + size);
  const std::uint32_t sum = checksum(block);
  std::memcpy(block.data(), &sum, sizeof sum);
  return block;
}

BlockHeader open_block(std::span<const std::uint8_t> block, BlockKind kind) {
  if (block.size() < kBlockHeader_bytes) throw CorruptData("a stored block is too short");
  std::uint32_t sum = 0;
  std::memcpy(&sum, block.data(), sizeof sum);
  if (sum != checksum(block)) throw CorruptData("a stored block does not match its checksum");
  if (block[4] != static_cast<std::uint8_t>(kind)) throw CorruptData("a stored block is of another kind");
  BlockHeader header{.kind = kind, .flags = block[5], .elements = 0};
  std::memcpy(&header.elements, &block[8], sizeof header.elements);
  return header;
}

std::vector<std::uint8_t> block_content(std::span<const std::uint8_t> block, std::size_t bytes) {
  const std::span<const std::uint8_t> frame = block.subspan(kBlockHeader_bytes);
  std::vector<std::uint8_t> content(bytes);
  const std::size_t size = ZSTD_decompress(content.data(), content.size(), frame.data(), frame.size());
  if (ZSTD_isError(size) || size != bytes) throw CorruptData("a stored block does not hold what it should");
  return content;
}

}  // namespace raywatch
