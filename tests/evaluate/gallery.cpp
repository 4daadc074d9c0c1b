#include "tests/evaluate/gallery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "tests/evaluate/testable.hpp"

namespace raywatch::evaluation {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kTogether_m = 1.0;
constexpr double kHalfView_m = 1.5;

/// The points of one scan of a case, as they were judged.
struct Judged {
  const ScanView& view;
  const std::vector<Truth>& truth;
  const std::vector<std::uint8_t>& called;
};

Judged judged_of(const PointError& error, const CaseViews& views, const CaseLabels& labels, const Verdicts& verdicts) {
  if (error.of_scan) return {views.scan, labels.truth.scan, verdicts.scan};
  return {views.priors[error.prior], labels.truth.priors[error.prior], verdicts.priors[error.prior]};
}

/// Where most of the points lie together: one of them, and how many.
struct Focus {
  std::size_t errors = 0;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
};

Focus focus_of(const std::vector<Eigen::Vector3d>& points_m) {
  constexpr std::size_t kTrials = 200;
  Focus focus;
  const std::size_t step = points_m.size() / kTrials + 1;
  for (std::size_t i = 0; i < points_m.size(); i += step) {
    const auto together = static_cast<std::size_t>(std::ranges::count_if(
        points_m, [&](const Eigen::Vector3d& p) { return (p - points_m[i]).norm() < kTogether_m; }));
    if (together > focus.errors) focus = {together, points_m[i]};
  }
  return focus;
}

/// A part of a panorama around a direction, in pixels.
class Window {
 public:
  Window(const Eigen::Vector3d& center_m, double spacing_rad)
      : azimuth_rad_(std::atan2(center_m.y(), center_m.x())),
        elevation_rad_(std::asin(center_m.z() / center_m.norm())),
        half_width_rad_(std::clamp(kHalfView_m / center_m.norm(), 12.0 * spacing_rad, 0.6)) {}

  struct Pixel {
    int x, y;
  };
  std::optional<Pixel> pixel_of(const Eigen::Vector3d& point_m) const {
    const double range_m = point_m.norm();
    if (!(range_m > 0.0)) return std::nullopt;
    const double azimuth_rad =
        std::remainder(std::atan2(point_m.y(), point_m.x()) - azimuth_rad_, 2 * std::numbers::pi);
    const double elevation_rad = std::asin(point_m.z() / range_m) - elevation_rad_;
    const double x = -azimuth_rad * std::cos(elevation_rad_) / half_width_rad_;
    const double y = -elevation_rad / half_width_rad_;
    constexpr double kHighest = static_cast<double>(kHeight) / kWidth;
    if (std::abs(x) > 1.0 || std::abs(y) > kHighest) return std::nullopt;
    return Pixel{static_cast<int>(0.5 * kWidth * (1.0 + x)), static_cast<int>(0.5 * kHeight + 0.5 * kWidth * y)};
  }
  /// Half the side of the square that stands for one shot.
  int half_shot(double spacing_rad) const {
    return std::clamp(static_cast<int>(0.25 * kWidth * spacing_rad / half_width_rad_), 1, 12);
  }

 private:
  double azimuth_rad_, elevation_rad_, half_width_rad_;
};

Colour paler(const Colour& colour) {
  Colour result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = static_cast<std::uint8_t>(128 + colour[i] / 2);
  return result;
}

Colour colour_of(const Judged& judged, std::uint32_t i, double range_m, double center_range_m, bool of_this_kind) {
  constexpr Colour kFound{30, 160, 60}, kMissed{240, 140, 0}, kFalse{215, 30, 40};
  const bool called = judged.called[i] != 0;
  if (judged.truth[i] == Truth::changed && called) return kFound;
  if (judged.truth[i] == Truth::changed) return of_this_kind ? kMissed : paler(kMissed);
  if (judged.truth[i] == Truth::unchanged && called) return of_this_kind ? kFalse : paler(kFalse);
  constexpr double kDepth_m = 5.0;
  const double depth = std::clamp((range_m - center_range_m) / kDepth_m, -1.0, 1.0);
  const auto grey = static_cast<std::uint8_t>(150 + 70 * depth);
  return {grey, grey, grey};
}

/// Draws the far points first, so that the near ones cover them, and the errors last.
Picture draw(const Judged& judged, const Eigen::Vector3d& center_m, const std::vector<std::uint32_t>& of_this_kind) {
  const PointCloud& points = judged.view.points;
  const double spacing_rad = testing_angle_rad(judged.view) / 1.5;
  const Window window(center_m, spacing_rad);
  struct Dot {
    Window::Pixel pixel;
    double range_m;
    std::uint32_t index;
    bool in_front;
  };
  std::vector<Dot> dots;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point_m = points[i].cast<double>();
    if (const auto pixel = window.pixel_of(point_m)) {
      dots.push_back({*pixel, point_m.norm(), i, judged.called[i] || judged.truth[i] == Truth::changed});
    }
  }
  std::ranges::stable_sort(
      dots, [](const Dot& a, const Dot& b) { return a.in_front != b.in_front ? b.in_front : a.range_m > b.range_m; });
  Picture picture(kWidth, kHeight);
  for (const Dot& dot : dots) {
    const bool this_kind = std::ranges::binary_search(of_this_kind, dot.index);
    picture.fill(dot.pixel.x, dot.pixel.y, window.half_shot(spacing_rad),
                 colour_of(judged, dot.index, dot.range_m, center_m.norm(), this_kind));
  }
  return picture;
}

/// Errors of one kind in one scan of the case.
struct ErrorKind {
  Cause cause;
  bool missed;
  bool of_scan;
  std::uint32_t prior;
  auto operator<=>(const ErrorKind&) const = default;
};

}  // namespace

void Gallery::add(const CaseViews& views, const CaseLabels& labels, const Verdicts& verdicts,
                  const std::vector<PointError>& errors) {
  std::map<ErrorKind, std::vector<const PointError*>> by_kind;
  for (const PointError& error : errors) {
    by_kind[{error.cause, error.missed, error.of_scan, error.prior}].push_back(&error);
  }
  for (const auto& [kind, members] : by_kind) {
    const Judged judged = judged_of(*members.front(), views, labels, verdicts);
    std::vector<Eigen::Vector3d> points_m;
    std::vector<std::uint32_t> indices;
    for (const PointError* error : members) {
      points_m.push_back(judged.view.points[error->index].cast<double>());
      indices.push_back(error->index);
    }
    const Focus focus = focus_of(points_m);
    const std::string name =
        std::string(kCauseNames[static_cast<std::size_t>(kind.cause)]) + (kind.missed ? "-missed" : "-false");
    const auto known = exhibits_.find(name);
    if (known != exhibits_.end() && known->second.errors >= focus.errors) continue;
    exhibits_.insert_or_assign(name, Exhibit{focus.errors, draw(judged, focus.point_m, indices)});
  }
}

void Gallery::write(const std::filesystem::path& folder) const {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw StorageError("cannot create " + folder.string() + ": " + error.message());
  for (const auto& [name, exhibit] : exhibits_) write_png(exhibit.picture, folder / (name + ".png"));
}

}  // namespace raywatch::evaluation
