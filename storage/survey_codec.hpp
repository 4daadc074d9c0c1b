#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/survey.hpp"
#include "storage/sealed_block.hpp"

namespace raywatch {

// The models of a survey in blocks of the kind `survey_model`, each of at most `kModelPiece_bytes` of one text of
// bytes:
//
//   origin x, y: 2 times f64 | cell: f64 | columns, rows: 2 times u32
//   of each epoch, n = columns * rows: height, sigma, spread, slope x, slope y, ceiling: 6 planes of n times f32
//     | count: n times u32
//   rise, random sigma, LoD95: 3 planes of n times f32
//   of each epoch: scans: u32 | of each scan: points: u64 | class: u8 a point | change: i32 a point
//
// Numbers are little endian.

inline constexpr std::size_t kModelPiece_bytes = std::size_t{4} << 20;

/// The models, their difference and what is said of the points. `ElevationModel::stations` is not kept.
std::vector<std::vector<std::uint8_t>> encode_models(const SurveyResult& survey);

/// Reads what `encode_models` made, block by block.
class ModelDecoder {
 public:
  /// @throws CorruptData.
  void add(std::span<const std::uint8_t> block);
  /// Puts it into a survey. @throws CorruptData when something is missing.
  void finish(SurveyResult& survey);

 private:
  std::vector<std::uint8_t> content_;
};

}  // namespace raywatch
