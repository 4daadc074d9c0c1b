#include "storage/survey_codec.hpp"

#include <algorithm>
#include <cstring>

#include "core/error.hpp"

namespace raywatch {
namespace {

class SurveyWriter {
 public:
  template <class T>
  void value(const T& value) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  template <class T, class Cells, class Get>
  void plane(const Cells& cells, Get get) {
    for (const auto& cell : cells) value(static_cast<T>(get(cell)));
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

class SurveyReader {
 public:
  explicit SurveyReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
  template <class T>
  T value() {
    require(sizeof(T));
    T value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_ = rest_.subspan(sizeof value);
    return value;
  }
  template <class T, class Cells, class Set>
  void plane(Cells& cells, Set set) {
    for (auto& cell : cells) set(cell, value<T>());
  }
  /// @throws CorruptData when so much is not there; asked before memory is taken for it.
  void require(std::uint64_t bytes) const {
    if (rest_.size() < bytes) throw CorruptData("the models of a survey are cut short");
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::span<const std::uint8_t> rest_;
};

constexpr std::size_t kBytesOfCell = 2 * 28 + 12;

void write_model(SurveyWriter& out, const ElevationModel& model) {
  using Cell = ElevationCell;
  out.plane<float>(model.cells, [](const Cell& c) { return c.height_m; });
  out.plane<float>(model.cells, [](const Cell& c) { return c.sigma_m; });
  out.plane<float>(model.cells, [](const Cell& c) { return c.spread_m; });
  out.plane<float>(model.cells, [](const Cell& c) { return c.slope.x(); });
  out.plane<float>(model.cells, [](const Cell& c) { return c.slope.y(); });
  out.plane<float>(model.cells, [](const Cell& c) { return c.ceiling_m; });
  out.plane<std::uint32_t>(model.cells, [](const Cell& c) { return c.count; });
}

ElevationModel read_model(SurveyReader& in, const GridLayout& layout) {
  using Cell = ElevationCell;
  ElevationModel model{.layout = layout, .cells = std::vector<Cell>(layout.cell_count()), .stations = {}};
  in.plane<float>(model.cells, [](Cell& c, float v) { c.height_m = v; });
  in.plane<float>(model.cells, [](Cell& c, float v) { c.sigma_m = v; });
  in.plane<float>(model.cells, [](Cell& c, float v) { c.spread_m = v; });
  in.plane<float>(model.cells, [](Cell& c, float v) { c.slope.x() = v; });
  in.plane<float>(model.cells, [](Cell& c, float v) { c.slope.y() = v; });
  in.plane<float>(model.cells, [](Cell& c, float v) { c.ceiling_m = v; });
  in.plane<std::uint32_t>(model.cells, [](Cell& c, std::uint32_t v) { c.count = v; });
  return model;
}

void write_points(SurveyWriter& out, const std::vector<EpochPoints>& scans) {
  out.value(static_cast<std::uint32_t>(scans.size()));
  for (const EpochPoints& scan : scans) {
    out.value(static_cast<std::uint64_t>(scan.classes.size()));
    out.plane<std::uint8_t>(scan.classes, [](PointClass c) { return c; });
    out.plane<std::int32_t>(scan.change_of, [](std::int32_t change) { return change; });
  }
}

std::vector<EpochPoints> read_points(SurveyReader& in) {
  std::vector<EpochPoints> scans;
  for (auto left = in.value<std::uint32_t>(); left > 0; --left) {
    const auto points = in.value<std::uint64_t>();
    in.require(points);
    EpochPoints& scan = scans.emplace_back();
    scan.classes.resize(points);
    scan.change_of.resize(points);
    in.plane<std::uint8_t>(scan.classes, [](PointClass& c, std::uint8_t v) {
      if (v >= kPointClasses) throw CorruptData("the models of a survey hold an unknown class");
      c = static_cast<PointClass>(v);
    });
    in.plane<std::int32_t>(scan.change_of, [](std::int32_t& change, std::int32_t v) { change = v; });
  }
  return scans;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> encode_models(const SurveyResult& survey) {
  SurveyWriter out;
  const GridLayout& layout = survey.before_model.layout;
  out.value(layout.origin_m.x());
  out.value(layout.origin_m.y());
  out.value(layout.cell_m);
  out.value(layout.columns);
  out.value(layout.rows);
  write_model(out, survey.before_model);
  write_model(out, survey.after_model);
  out.plane<float>(survey.difference, [](const DifferenceCell& c) { return c.rise_m; });
  out.plane<float>(survey.difference, [](const DifferenceCell& c) { return c.random_sigma_m; });
  out.plane<float>(survey.difference, [](const DifferenceCell& c) { return c.lod95_m; });
  write_points(out, survey.before_points);
  write_points(out, survey.after_points);
  BlockSealer sealer;
  std::vector<std::vector<std::uint8_t>> blocks;
  for (std::size_t first = 0; first < out.bytes().size(); first += kModelPiece_bytes) {
    const auto piece = std::span(out.bytes()).subspan(first, std::min(kModelPiece_bytes, out.bytes().size() - first));
    blocks.push_back(
        sealer.seal({.kind = BlockKind::survey_model, .elements = static_cast<std::uint32_t>(piece.size())}, piece));
  }
  return blocks;
}

void ModelDecoder::add(std::span<const std::uint8_t> block) {
  const BlockHeader header = open_block(block, BlockKind::survey_model);
  if (header.elements > kModelPiece_bytes) throw CorruptData("a piece of the models of a survey is too long");
  const std::vector<std::uint8_t> piece = block_content(block, header.elements);
  content_.insert(content_.end(), piece.begin(), piece.end());
}

void ModelDecoder::finish(SurveyResult& survey) {
  SurveyReader in(content_);
  GridLayout layout;
  layout.origin_m.x() = in.value<double>();
  layout.origin_m.y() = in.value<double>();
  layout.cell_m = in.value<double>();
  layout.columns = in.value<std::uint32_t>();
  layout.rows = in.value<std::uint32_t>();
  in.require(std::uint64_t{kBytesOfCell} * layout.cell_count());
  survey.before_model = read_model(in, layout);
  survey.after_model = read_model(in, layout);
  survey.difference.assign(layout.cell_count(), {});
  in.plane<float>(survey.difference, [](DifferenceCell& c, float v) { c.rise_m = v; });
  in.plane<float>(survey.difference, [](DifferenceCell& c, float v) { c.random_sigma_m = v; });
  in.plane<float>(survey.difference, [](DifferenceCell& c, float v) { c.lod95_m = v; });
  survey.before_points = read_points(in);
  survey.after_points = read_points(in);
  if (!in.at_end()) throw CorruptData("the models of a survey are too long");
}

}  // namespace raywatch
