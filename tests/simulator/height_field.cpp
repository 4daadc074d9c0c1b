#include "tests/simulator/height_field.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace raywatch::simulator {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// How far, in metres, a ray is pushed over a border to be sure to stand in the next cell.
constexpr double kNudge_m = 1e-10;
/// How deep below the surface a ray may be found when it passed a corner between two cells.
constexpr double kSliver_m = 1e-6;

std::vector<double> sampled(const FieldLayout& layout, const std::function<double(const Eigen::Vector2d&)>& height_m) {
  std::vector<double> heights_m;
  heights_m.reserve(layout.node_count());
  for (std::uint32_t row = 0; row < layout.rows; ++row) {
    for (std::uint32_t column = 0; column < layout.columns; ++column) {
      heights_m.push_back(height_m(layout.node_m(column, row)));
    }
  }
  return heights_m;
}

/// The smallest t in [from, to] with a t^2 + b t + c = 0.
std::optional<double> first_root(const std::array<double, 3>& abc, double from, double to) {
  const auto [a, b, c] = abc;
  const auto within = [&](double t) { return t >= from && t <= to; };
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return std::nullopt;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  double first = a != 0.0 ? q / a : kInfinity;
  double second = q != 0.0 ? c / q : kInfinity;
  if (first > second) std::swap(first, second);
  if (within(first)) return first;
  if (within(second)) return second;
  return std::nullopt;
}

/// The part of a ray, as from..to along it, inside one interval of one axis.
void clip(double origin, double direction, double size, double& from, double& to) {
  if (direction == 0.0) {
    if (origin < 0.0 || origin > size) to = -kInfinity;
    return;
  }
  const double a = -origin / direction;
  const double b = (size - origin) / direction;
  from = std::max(from, std::min(a, b));
  to = std::min(to, std::max(a, b));
}

/// Where along the ray the block of cells with first cell `block << level` ends, in one axis.
double block_end(double origin, double direction, std::uint32_t block, unsigned level) {
  if (direction == 0.0) return kInfinity;
  const std::uint64_t border = (std::uint64_t{block} + (direction > 0.0 ? 1 : 0)) << level;
  return (static_cast<double>(border) - origin) / direction;
}

std::uint32_t cell_index(double place, std::uint32_t nodes) {
  const double last = static_cast<double>(nodes - 2);
  return static_cast<std::uint32_t>(std::clamp(std::floor(place), 0.0, last));
}

/// The cell that the ray goes through next after `t`, in one axis. On a border, which rounding does not let a ray leave
/// that hardly moves along this axis, it is the cell on the side to which the ray goes.
std::uint32_t cell_ahead(double origin, double direction, double t, std::uint32_t nodes) {
  const std::uint32_t cell = cell_index(origin + direction * (t + kNudge_m), nodes);
  if (block_end(origin, direction, cell, 0) > t) return cell;
  return direction > 0.0 ? std::min(cell + 1, nodes - 2) : std::max(cell, 1u) - 1;
}

}  // namespace

/// One cell: z = a + b u + c v + d u v for u, v in 0..1.
struct HeightField::Patch {
  double a, b, c, d;

  Patch(const HeightField& field, std::uint32_t column, std::uint32_t row) {
    const double z00 = field.node_height_m(column, row);
    const double z10 = field.node_height_m(column + 1, row);
    const double z01 = field.node_height_m(column, row + 1);
    const double z11 = field.node_height_m(column + 1, row + 1);
    a = z00;
    b = z10 - z00;
    c = z01 - z00;
    d = z11 - z10 - z01 + z00;
  }
  double at(double u, double v) const { return a + b * u + c * v + d * u * v; }
};

HeightField::HeightField(const FieldLayout& layout, std::vector<double> heights_m)
    : layout_(layout), heights_m_(std::move(heights_m)) {
  assert(layout_.columns >= 2 && layout_.rows >= 2 && heights_m_.size() == layout_.node_count());
  build_pyramid();
}

HeightField::HeightField(const FieldLayout& layout, const std::function<double(const Eigen::Vector2d&)>& height_m)
    : HeightField(layout, sampled(layout, height_m)) {}

void HeightField::build_pyramid() {
  Level cells{layout_.columns - 1, layout_.rows - 1, {}, {}};
  for (std::uint32_t row = 0; row < cells.rows; ++row) {
    for (std::uint32_t column = 0; column < cells.columns; ++column) {
      const auto [low, high] = std::minmax({node_height_m(column, row), node_height_m(column + 1, row),
                                            node_height_m(column, row + 1), node_height_m(column + 1, row + 1)});
      cells.lowest_m.push_back(low);
      cells.highest_m.push_back(high);
    }
  }
  levels_.push_back(std::move(cells));
  while (levels_.back().columns > 1 || levels_.back().rows > 1) {
    const Level& fine = levels_.back();
    Level coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}, {}};
    coarse.lowest_m.assign(std::size_t{coarse.columns} * coarse.rows, kInfinity);
    coarse.highest_m.assign(std::size_t{coarse.columns} * coarse.rows, -kInfinity);
    for (std::uint32_t row = 0; row < fine.rows; ++row) {
      for (std::uint32_t column = 0; column < fine.columns; ++column) {
        const std::size_t from = std::size_t{row} * fine.columns + column;
        const std::size_t to = std::size_t{row / 2} * coarse.columns + column / 2;
        coarse.lowest_m[to] = std::min(coarse.lowest_m[to], fine.lowest_m[from]);
        coarse.highest_m[to] = std::max(coarse.highest_m[to], fine.highest_m[from]);
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

double HeightField::height_m(const Eigen::Vector2d& place_m) const {
  const Eigen::Vector2d place = (place_m - layout_.origin_m) / layout_.cell_m;
  const std::uint32_t column = cell_index(place.x(), layout_.columns);
  const std::uint32_t row = cell_index(place.y(), layout_.rows);
  return Patch(*this, column, row).at(std::clamp(place.x() - column, 0.0, 1.0), std::clamp(place.y() - row, 0.0, 1.0));
}

std::size_t HeightField::cell_at(const Eigen::Vector2d& place_m) const {
  const Eigen::Vector2d place = (place_m - layout_.origin_m) / layout_.cell_m;
  return std::size_t{cell_index(place.y(), layout_.rows)} * (layout_.columns - 1) +
         cell_index(place.x(), layout_.columns);
}

Eigen::Vector3d HeightField::normal(const Eigen::Vector2d& place_m) const {
  const Eigen::Vector2d place = (place_m - layout_.origin_m) / layout_.cell_m;
  const std::uint32_t column = cell_index(place.x(), layout_.columns);
  const std::uint32_t row = cell_index(place.y(), layout_.rows);
  const Patch patch(*this, column, row);
  const double slope_x = (patch.b + patch.d * (place.y() - row)) / layout_.cell_m;
  const double slope_y = (patch.c + patch.d * (place.x() - column)) / layout_.cell_m;
  return Eigen::Vector3d(-slope_x, -slope_y, 1.0).normalized();
}

/// A ray in the units of the field: cells along x and y, metres along z and along the ray.
struct HeightField::CellRay {
  double u0, v0, z0;
  double du, dv, dz;

  CellRay(const Ray& ray, const FieldLayout& layout)
      : u0((ray.origin_m.x() - layout.origin_m.x()) / layout.cell_m),
        v0((ray.origin_m.y() - layout.origin_m.y()) / layout.cell_m),
        z0(ray.origin_m.z()),
        du(ray.direction.x() / layout.cell_m),
        dv(ray.direction.y() / layout.cell_m),
        dz(ray.direction.z()) {}
  double u(double t) const { return u0 + du * t; }
  double v(double t) const { return v0 + dv * t; }
  double z(double t) const { return z0 + dz * t; }
};

HeightField::Stretch HeightField::stretch_within(const CellRay& ray) const {
  Stretch within{kNearestHit_m, kInfinity};
  clip(ray.u0, ray.du, layout_.columns - 1, within.from, within.to);
  clip(ray.v0, ray.dv, layout_.rows - 1, within.from, within.to);
  const double low_m = lowest_m() - kSliver_m;
  clip(ray.z0 - low_m, ray.dz, highest_m() + kSliver_m - low_m, within.from, within.to);
  return within;
}

bool HeightField::may_hit(const CellRay& ray, const Stretch& part, const Level& level, std::size_t block) {
  const auto [low_m, high_m] = std::minmax({ray.z(part.from), ray.z(part.to)});
  return low_m <= level.highest_m[block] + kSliver_m && high_m >= level.lowest_m[block] - kSliver_m;
}

std::optional<double> HeightField::hit_in_cell(const CellRay& ray, const Stretch& part, std::uint32_t column,
                                               std::uint32_t row) const {
  // The equation is written relative to the start of the stretch, where the numbers are small.
  const Patch patch(*this, column, row);
  const double u = ray.u(part.from) - column;
  const double v = ray.v(part.from) - row;
  const double a = -patch.d * ray.du * ray.dv;
  const double b = ray.dz - patch.b * ray.du - patch.c * ray.dv - patch.d * (u * ray.dv + v * ray.du);
  const double c = ray.z(part.from) - patch.at(u, v);
  const auto root = first_root({a, b, c}, -kNudge_m, part.to - part.from + kNudge_m);
  if (!root || part.from + *root <= kNearestHit_m) return std::nullopt;
  return part.from + *root;
}

std::optional<double> HeightField::intersect(const Ray& ray) const {
  const CellRay cell_ray(ray, layout_);
  Stretch ahead = stretch_within(cell_ray);
  const auto top = static_cast<unsigned>(levels_.size() - 1);
  unsigned level = top;
  while (ahead.from < ahead.to) {
    const std::uint32_t column = cell_ahead(cell_ray.u0, cell_ray.du, ahead.from, layout_.columns);
    const std::uint32_t row = cell_ahead(cell_ray.v0, cell_ray.dv, ahead.from, layout_.rows);
    const double leave_m = std::min({ahead.to, block_end(cell_ray.u0, cell_ray.du, column >> level, level),
                                     block_end(cell_ray.v0, cell_ray.dv, row >> level, level)});
    const Stretch part{ahead.from, std::max(leave_m, ahead.from + kNudge_m)};
    const std::size_t block = std::size_t{row >> level} * levels_[level].columns + (column >> level);
    if (!may_hit(cell_ray, part, levels_[level], block)) {
      ahead.from = part.to;
      level = std::min(level + 1, top);
    } else if (level > 0) {
      --level;
    } else {
      if (const auto hit = hit_in_cell(cell_ray, part, column, row)) return hit;
      ahead.from = part.to;
    }
  }
  return std::nullopt;
}

namespace {

/// The four corner differences of one cell, and their bilinear interpolation.
struct Difference {
  double d00, d10, d01, d11;
  double at(double u, double v) const {
    return (d00 * (1.0 - u) + d10 * u) * (1.0 - v) + (d01 * (1.0 - u) + d11 * u) * v;
  }
};

void add_mixed_cell(const Difference& difference, double area_m2, VolumeChange& sum) {
  constexpr int kSteps = 16;
  for (int row = 0; row < kSteps; ++row) {
    for (int column = 0; column < kSteps; ++column) {
      const double height_m = difference.at((column + 0.5) / kSteps, (row + 0.5) / kSteps);
      (height_m > 0.0 ? sum.filled_m3 : sum.cut_m3) += std::abs(height_m) * area_m2 / (kSteps * kSteps);
    }
  }
}

}  // namespace

double mean_height_m(const HeightField& field, const Eigen::AlignedBox2d& area_m) {
  const FieldLayout& layout = field.layout();
  const Eigen::Array2d from = (area_m.min() - layout.origin_m) / layout.cell_m;
  const Eigen::Array2d to = (area_m.max() - layout.origin_m) / layout.cell_m;
  double sum = 0.0;
  for (double row = std::floor(from.y()); row < to.y(); ++row) {
    for (double column = std::floor(from.x()); column < to.x(); ++column) {
      const Eigen::Array2d low = from.max(Eigen::Array2d(column, row));
      const Eigen::Array2d high = to.min(Eigen::Array2d(column + 1.0, row + 1.0));
      const Eigen::Vector2d middle_m = layout.origin_m + layout.cell_m * (0.5 * (low + high)).matrix();
      sum += field.height_m(middle_m) * (high - low).prod();
    }
  }
  return sum / (to - from).prod();
}

VolumeChange volume_change(const HeightField& before, const HeightField& after) {
  const FieldLayout& layout = before.layout();
  assert(layout.columns == after.layout().columns && layout.rows == after.layout().rows);
  const double area_m2 = layout.cell_m * layout.cell_m;
  VolumeChange sum;
  for (std::size_t row = 0; row + 1 < layout.rows; ++row) {
    for (std::size_t column = 0; column + 1 < layout.columns; ++column) {
      const std::size_t node = row * layout.columns + column;
      const auto risen = [&](std::size_t i) { return after.heights_m()[i] - before.heights_m()[i]; };
      const Difference difference{risen(node), risen(node + 1), risen(node + layout.columns),
                                  risen(node + layout.columns + 1)};
      const auto [low, high] = std::minmax({difference.d00, difference.d10, difference.d01, difference.d11});
      if (low < 0.0 && high > 0.0) {
        add_mixed_cell(difference, area_m2, sum);
      } else {
        (high > 0.0 ? sum.filled_m3 : sum.cut_m3) += std::abs(difference.at(0.5, 0.5)) * area_m2;
      }
    }
  }
  return sum;
}

}  // namespace raywatch::simulator
