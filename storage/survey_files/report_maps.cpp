#include "storage/survey_files/report_maps.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "storage/survey_files/map_image.hpp"
#include "storage/survey_files/report_text.hpp"

namespace raywatch {
namespace {

std::string length(double metres) { return std::to_string(std::round(metres * 100.0) / 100.0); }

std::string swatch(const Colour& colour, std::string_view label) {
  const std::string rgb = std::to_string(colour[0]) + "," + std::to_string(colour[1]) + "," + std::to_string(colour[2]);
  return "<li><svg viewBox=\"0 0 2 1\" preserveAspectRatio=\"none\" aria-hidden=\"true\"><rect width=\"2\" "
         "height=\"1\" "
         "fill=\"rgb(" +
         rgb + ")\"/></svg>" + escaped(label) + "</li>";
}

/// A length of 1, 2 or 5 times a power of ten, at most a third of the width.
double ruler_m(double width_m) {
  const double most_m = width_m / 3.0, power = std::pow(10.0, std::floor(std::log10(most_m)));
  return power * (5.0 * power <= most_m ? 5.0 : 2.0 * power <= most_m ? 2.0 : 1.0);
}

/// What lies over a map, in metres from its north-west corner.
class Overlay {
 public:
  explicit Overlay(const SurveyDocument& document) : document_(document), layout_(document.survey.after_model.layout) {}

  double width_m() const { return layout_.cell_m * layout_.columns; }
  double height_m() const { return layout_.cell_m * layout_.rows; }

  std::string svg() const {
    std::string result;
    for (const ZoneFigures& zone : document_.survey.zones) result += outline(zone.zone);
    result += ruler() + north();
    return result;
  }

 private:
  double text_m() const { return std::max(width_m(), height_m()) / 34.0; }
  std::string x(double x_m) const { return length(x_m - layout_.origin_m.x()); }
  std::string y(double y_m) const { return length(layout_.origin_m.y() + height_m() - y_m); }

  std::string text(double right_m, double down_m, const char* anchor, const std::string& what) const {
    return "<text x=\"" + length(right_m) + "\" y=\"" + length(down_m) + "\" text-anchor=\"" + anchor +
           "\" font-size=\"" + length(text_m()) + "\" stroke-width=\"" + length(0.22 * text_m()) + "\">" +
           escaped(what) + "</text>";
  }

  std::string outline(const SurveyZone& zone) const {
    std::string points;
    Eigen::Vector2d top_m = zone.prism.polygon_m.front();
    for (const Eigen::Vector2d& corner_m : zone.prism.polygon_m) {
      points += x(corner_m.x()) + "," + y(corner_m.y()) + " ";
      if (corner_m.y() > top_m.y() || (corner_m.y() == top_m.y() && corner_m.x() < top_m.x())) top_m = corner_m;
    }
    const std::string shape = " points=\"" + points + "\"/>";
    const double right_m = top_m.x() - layout_.origin_m.x() + 0.5 * text_m();
    const double down_m = layout_.origin_m.y() + height_m() - top_m.y() + 1.3 * text_m();
    return "<polygon class=\"halo\"" + shape + "<polygon class=\"zone\"" + shape +
           text(right_m, down_m, "start", zone.name);
  }

  std::string ruler() const {
    const double long_m = ruler_m(width_m()), thick_m = 0.35 * text_m();
    const double left_m = 0.8 * text_m(), down_m = height_m() - 1.2 * text_m();
    const std::string bar = "<rect class=\"ruler\" x=\"" + length(left_m) + "\" y=\"" + length(down_m) + "\" width=\"" +
                            length(long_m) + "\" height=\"" + length(thick_m) + "\"/>";
    return bar + text(left_m, down_m - 0.4 * text_m(), "start", number_text(long_m, long_m < 1.0 ? 1 : 0) + " m");
  }

  std::string north() const {
    const double right_m = width_m() - 1.3 * text_m(), down_m = height_m() - 1.0 * text_m(), size_m = text_m();
    const std::string arrow = "<path class=\"ruler\" d=\"M" + length(right_m) + " " + length(down_m - 2.0 * size_m) +
                              "l" + length(0.5 * size_m) + " " + length(1.1 * size_m) + "h" + length(-size_m) + "z\"/>";
    const std::optional<MineGrid>& grid = document_.frame.grid;
    if (!grid) return arrow + text(right_m, down_m, "middle", "N");
    // Maps lie along the site's axes: the grid's north is turned clockwise by as much as they are counter-clockwise.
    const std::string turn = "rotate(" + length(grid->rotation_rad * 180.0 / std::numbers::pi) + " " + length(right_m) +
                             " " + length(down_m - 1.3 * size_m) + ")";
    return "<g transform=\"" + turn + "\">" + arrow + "</g>" + text(right_m, down_m + 0.4 * size_m, "end", "grid N");
  }

  const SurveyDocument& document_;
  const GridLayout& layout_;
};

/// @param most_px of its longer side.
std::string map(const Overlay& overlay, const MapImage& image, const std::string& label, double most_px) {
  const double px_a_metre = most_px / std::max(overlay.width_m(), overlay.height_m());
  const auto sized = [&](double scale) {
    return "width=\"" + length(scale * overlay.width_m()) + "\" height=\"" + length(scale * overlay.height_m()) + "\"";
  };
  return "<svg class=\"map\" " + sized(px_a_metre) + " viewBox=\"0 0 " + length(overlay.width_m()) + " " +
         length(overlay.height_m()) + "\" role=\"img\" aria-label=\"" + escaped(label) + "\"><image " + sized(1.0) +
         " preserveAspectRatio=\"none\" href=\"" + png_data_uri(image) + "\"/>" + overlay.svg() + "</svg>";
}

std::string ramp_legend() {
  std::string legend = "<ul class=\"legend\">";
  for (const RampStep& step : difference_ramp()) legend += swatch(step.colour, step.label);
  return legend + swatch(kUnchangedColour, "no change that can be told") +
         swatch(kUnseenColour, "white, hatched: not seen in both") + "</ul>";
}

std::string seen_legend() {
  constexpr SeenColours kColours;
  return "<ul class=\"legend below\">" + swatch(kColours.both, "seen in both epochs") +
         swatch(kColours.before, "before only") + swatch(kColours.after, "after only") +
         swatch(kColours.neither, "in neither") + "</ul>";
}

}  // namespace

std::string report_maps(const SurveyDocument& document) {
  constexpr double kLarge_px = 700.0, kSmall_px = 420.0;
  const SurveyResult& survey = document.survey;
  const Overlay overlay(document);
  const auto figure = [](const char* size, const std::string& title, const std::string& body) {
    return "<figure class=\"" + std::string(size) + "\"><figcaption>" + title + "</figcaption>" + body + "</figure>";
  };
  std::string html = "<div class=\"maps\">";
  html += figure("large", "Difference: how far the ground rose or fell",
                 "<div class=\"plate\">" +
                     map(overlay, difference_map(survey.before_model, survey.after_model, survey.difference),
                         "Map of the difference", kLarge_px) +
                     ramp_legend() + "</div>");
  html += figure("small", "Ground before",
                 map(overlay, height_map(survey.before_model), "Shaded ground before", kSmall_px));
  html +=
      figure("small", "Ground after", map(overlay, height_map(survey.after_model), "Shaded ground after", kSmall_px));
  html += figure("small", "What was seen",
                 map(overlay, seen_map(survey.before_model, survey.after_model), "Map of what was seen", kSmall_px) +
                     seen_legend());
  return html + "</div>";
}

}  // namespace raywatch
