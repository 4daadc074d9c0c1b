#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct ZSTD_CCtx_s;

namespace raywatch {

// A sealed block is how every blob of a payload file is written: compressed, and with a checksum that finds any change
// of up to four neighbouring bytes for certain, others with all but 2^-32.
//
//   byte 0   u32  CRC-32 (as in zlib) of all bytes that follow
//        4   u8   kind, what the bytes mean: see BlockKind
//        5   u8   flags, of the kind
//        6   u16  0
//        8   u32  elements, counted as the kind counts them
//       12   ...  one zstd frame, to the end of the block
//
// All numbers are little endian. How long the content is follows from kind, flags and elements, never from the frame,
// so that a hostile block cannot ask for memory.

enum class BlockKind : std::uint8_t {
  scan_points = 'S',
  point_classes = 'C',
  prior_points = 'P',
  panorama = 'V',
  survey_model = 'M'
};

struct BlockHeader {
  BlockKind kind = BlockKind::scan_points;
  std::uint8_t flags = 0;
  std::uint32_t elements = 0;
};

/// Writes blocks; keeps the compressor's memory between them. Not thread-safe.
class BlockSealer {
 public:
  BlockSealer();
  ~BlockSealer();
  std::vector<std::uint8_t> seal(const BlockHeader& header, std::span<const std::uint8_t> content);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
};

/// Checks the checksum and the kind. @throws CorruptData.
BlockHeader open_block(std::span<const std::uint8_t> block, BlockKind kind);

/// The content of a block that `open_block` accepted, which must have exactly `bytes` bytes. @throws CorruptData.
std::vector<std::uint8_t> block_content(std::span<const std::uint8_t> block, std::size_t bytes);

}  // namespace raywatch
