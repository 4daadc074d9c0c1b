#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "storage/formats/decode.hpp"
#include "storage/formats/records.hpp"
#include "storage/formats/text_lines.hpp"

namespace raywatch {
namespace {

/// How far rounding in the text may make the two forms of the pose differ, and the axes be no rotation.
constexpr double kPositionTolerance_m = 1e-3;
constexpr double kAxisTolerance = 1e-3;

/// One scan's header. The points follow column by column, so a row of the `ShotGrid` is one column of the scanner.
struct PtxHeader {
  std::uint64_t columns = 0;
  std::uint64_t rows = 0;
  Pose world_from_sensor;
};

/// The lines of the file as rows of numbers.
class PtxLines {
 public:
  explicit PtxLines(std::string_view text) : lines_(text) {}

  /// Steps over blank lines. @returns false at the end of the file.
  bool next() {
    while (lines_.next()) {
      split_words(lines_.line(), words_);
      if (!words_.empty()) return true;
    }
    return false;
  }

  /// The next line's numbers. @throws InvalidInput unless it has `n` of them; `what` stands in the message.
  void require(std::size_t n, const char* what) {
    if (!next()) throw InvalidInput(std::string("the PTX file ends where ") + what + " should stand: it is truncated");
    if (words_.size() != n) refuse(std::string(what) + " needs " + std::to_string(n) + " values");
  }

  double real(std::size_t word) const { return parse_real(words_[word], lines_.number()); }
  std::uint64_t count(std::size_t word) const { return parse_count(words_[word], lines_.number()); }
  std::size_t words() const { return words_.size(); }
  std::size_t bytes_left() const { return lines_.bytes_left(); }
  std::size_t number() const { return lines_.number(); }
  Pose checked(const Eigen::Vector3d& position_m, const Eigen::Quaterniond& orientation) const {
    return checked_pose_at(at_line(lines_.number()) + "the pose above", position_m, orientation.coeffs());
  }
  [[noreturn]] void refuse(const std::string& message) const { throw InvalidInput(at_line(lines_.number()) + message); }

 private:
  TextLines lines_;
  std::vector<std::string_view> words_;
};

/// Rows are written as rows of the file: row i of a matrix for row vectors.
template <int columns>
Eigen::Matrix<double, 4, columns> read_matrix(PtxLines& lines, const char* what) {
  Eigen::Matrix<double, 4, columns> matrix;
  for (int row = 0; row < 4; ++row) {
    lines.require(columns, what);
    for (int column = 0; column < columns; ++column) matrix(row, column) = lines.real(static_cast<std::size_t>(column));
  }
  return matrix;
}

/// The pose stands there twice: as position and axes of the scanner, and as a matrix for row vectors.
Pose read_pose(PtxLines& lines) {
  const auto frame = read_matrix<3>(lines, "position and axes of the scanner");
  const auto matrix = read_matrix<4>(lines, "the transformation matrix");
  if (!frame.allFinite() || !matrix.allFinite()) lines.refuse("the pose above is not finite");
  if (!matrix.col(3).isApprox(Eigen::Vector4d::UnitW(), kAxisTolerance)) {
    lines.refuse("the last column of the transformation matrix above is not 0 0 0 1");
  }
  const Eigen::Vector3d position_m = matrix.row(3).head<3>();
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>().transpose();
  const double off_position_m = (frame.row(0).transpose() - position_m).cwiseAbs().maxCoeff();
  const double off_axes = (frame.bottomRows<3>().transpose() - rotation).cwiseAbs().maxCoeff();
  if (off_position_m > kPositionTolerance_m || off_axes > kAxisTolerance) {
    lines.refuse("the scanner's position and axes contradict the transformation matrix above");
  }
  const double off_orthonormal = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off_orthonormal > kAxisTolerance || rotation.determinant() < 0.0) {
    lines.refuse("the transformation matrix above is no rotation");
  }
  return lines.checked(position_m, Eigen::Quaterniond(rotation).normalized());
}

/// The line with the number of columns has been read.
PtxHeader read_header(PtxLines& lines) {
  PtxHeader header;
  if (lines.words() != 1) lines.refuse("the number of columns of the next scan should stand alone here");
  header.columns = lines.count(0);
  lines.require(1, "the number of rows");
  header.rows = lines.count(0);
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (header.columns > kMost || header.rows > kMost) lines.refuse("more than 2^32 columns or rows");
  header.world_from_sensor = read_pose(lines);
  return header;
}

/// A line has x y z, often an intensity, sometimes a colour after it. A cell without a return is 0 0 0; it has no place
/// in the world, so it stays as it is.
void append_cell(PointCloud& cloud, const PtxLines& lines, const Placement& placement, std::size_t columns) {
  const Eigen::Vector3d point_m(lines.real(0), lines.real(1), lines.real(2));
  if (point_m.isZero(0.0)) {
    cloud.push_back(0.0F, 0.0F, 0.0F);
  } else {
    append_placed(cloud, placement, point_m);
  }
  if (columns > 3) cloud.intensity.push_back(narrowed(lines.real(3), cloud.size() - 1));
}

PointCloud read_cells(PtxLines& lines, const PtxHeader& header, const Placement& placement,
                      const ScanFileLimits& limits) {
  constexpr std::uint64_t kShortestCell = 6;  // "0 0 0" and the line's end, which the last may lack
  const std::uint64_t cells = header.columns * header.rows;
  check_promise("the PTX header before line " + std::to_string(lines.number() + 1), cells, kShortestCell,
                lines.bytes_left() + 1, limits);
  PointCloud cloud;
  cloud.reserve(cells);
  std::size_t columns = 0;
  while (cloud.size() < cells) {
    if (!lines.next()) {
      throw InvalidInput("the PTX header promises " + std::to_string(cells) + " points, but the file ends after " +
                         std::to_string(cloud.size()) + ": it is truncated");
    }
    if (columns == 0) columns = lines.words();
    if (columns != lines.words() || (columns != 3 && columns != 4 && columns != 7)) {
      lines.refuse("a point has 3, 4 or 7 values, all of a scan alike, but here are " + std::to_string(lines.words()));
    }
    append_cell(cloud, lines, placement, columns);
  }
  cloud.grid =
      ShotGrid{.rows = static_cast<std::uint32_t>(header.columns), .columns = static_cast<std::uint32_t>(header.rows)};
  return cloud;
}

}  // namespace

std::vector<DecodedScan> decode_ptx(std::span<const std::byte> bytes, const ScanHints& hints,
                                    const ScanFileLimits& limits) {
  std::vector<DecodedScan> scans;
  PtxLines lines(as_text(bytes));
  while (lines.next()) {
    const PtxHeader header = read_header(lines);
    const Placement placement = placement_of(hints, Frame::sensor, header.world_from_sensor);
    DecodedScan scan;
    scan.points = read_cells(lines, header, placement, limits);
    scan.world_from_sensor = placement.world_from_sensor;
    scans.push_back(std::move(scan));
  }
  if (scans.empty()) throw InvalidInput("the PTX file holds no scan");
  if (scans.size() > 1 && hints.pose) {
    throw InvalidInput(
        "one pose is given, but the file holds " + std::to_string(scans.size()) + " scans, each with its own",
        {{"pose", "cannot stand for several scans"}});
  }
  return scans;
}

}  // namespace raywatch
