#include "storage/formats/records.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "storage/formats/huge_pages.hpp"

namespace raywatch {
namespace {

/// So many points are read into the three planes in turn: what they fill stays in the cache while it is zeroed and
/// overwritten.
constexpr std::size_t kBlock = 4096;

template <std::endian order>
void copy_floats(const FieldView& field, std::size_t first, std::size_t last, std::vector<float>& plane) {
  plane.resize(last);
  for (std::size_t i = first; i < last; ++i) plane[i] = load<float, order>(field.first + i * field.stride);
}

template <std::endian order>
void copy_points(const PointFields& fields, std::size_t count, PointCloud& cloud) {
  for (std::size_t first = 0; first < count; first += kBlock) {
    const std::size_t last = std::min(count, first + kBlock);
    copy_floats<order>(fields.x, first, last, cloud.x_m);
    copy_floats<order>(fields.y, first, last, cloud.y_m);
    copy_floats<order>(fields.z, first, last, cloud.z_m);
  }
}

template <std::endian order>
double load_double(const FieldView& field, std::size_t i) {
  const std::byte* at = field.first + i * field.stride;
  return visit_number(field.type, [at]<class T>(T) { return static_cast<double>(load<T, order>(at)); });
}

template <std::endian order>
void place_points(const PointFields& fields, std::size_t count, const Placement& placement, PointCloud& cloud) {
  for (std::size_t i = 0; i < count; ++i) {
    append_placed(cloud, placement,
                  {load_double<order>(fields.x, i), load_double<order>(fields.y, i), load_double<order>(fields.z, i)});
  }
}

template <std::endian order>
void read_intensity(const FieldView& field, std::size_t count, std::vector<float>& intensity) {
  intensity.reserve(count);
  prefer_huge_pages(intensity.data(), count * sizeof(float));
  if (field.type == NumberType::f32) {
    for (std::size_t first = 0; first < count; first += kBlock) {
      copy_floats<order>(field, first, std::min(count, first + kBlock), intensity);
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) intensity.push_back(narrowed(load_double<order>(field, i), i));
}

template <std::endian order>
PointCloud read_ordered(const PointFields& fields, std::size_t count, const Placement& placement) {
  PointCloud cloud;
  cloud.reserve(count);
  for (const auto* plane : {&cloud.x_m, &cloud.y_m, &cloud.z_m}) {
    prefer_huge_pages(plane->data(), count * sizeof(float));
  }
  const bool floats =
      fields.x.type == NumberType::f32 && fields.y.type == NumberType::f32 && fields.z.type == NumberType::f32;
  if (floats && !placement.moves_points()) {
    copy_points<order>(fields, count, cloud);
  } else {
    place_points<order>(fields, count, placement, cloud);
  }
  if (fields.intensity) read_intensity<order>(*fields.intensity, count, cloud.intensity);
  return cloud;
}

}  // namespace

std::size_t size_of(NumberType type) {
  return visit_number(type, []<class T>(T) { return sizeof(T); });
}

PointCloud read_point_fields(const PointFields& fields, std::size_t count, const Placement& placement) {
  return fields.order == std::endian::little ? read_ordered<std::endian::little>(fields, count, placement)
                                             : read_ordered<std::endian::big>(fields, count, placement);
}

void check_promise(const std::string& place, std::uint64_t points, std::uint64_t bytes_per_point,
                   std::uint64_t bytes_left, const ScanFileLimits& limits) {
  if (points == 0) throw InvalidInput(place + " promises no points: the scan is empty");
  const std::optional<std::uint64_t> needed = checked_product(points, bytes_per_point);
  if (!needed || *needed > bytes_left) {
    throw InvalidInput(place + " promises " + std::to_string(points) + " points, which need " +
                       (needed ? "at least " + std::to_string(*needed) : "more than 2^64") + " bytes, but only " +
                       std::to_string(bytes_left) + " follow: the file is truncated or its header is wrong");
  }
  if (points > limits.max_points) {
    throw TooLarge(place + " promises " + std::to_string(points) + " points; the limit is " +
                   std::to_string(limits.max_points));
  }
}

}  // namespace raywatch
