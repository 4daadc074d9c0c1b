#include <cmath>
#include <cstring>

#include "api/call.hpp"
#include "api/conditional.hpp"
#include "api/endpoints/survey_endpoints.hpp"
#include "api/lookup.hpp"
#include "api/render.hpp"
#include "api/render_survey.hpp"

namespace raywatch::endpoints {
namespace {

enum class GridFormat { json, bin };

GridFormat parse_grid_format(const std::string& name) {
  if (name == "json") return GridFormat::json;
  if (name == "bin") return GridFormat::bin;
  throw InvalidInput("must be json or bin");
}

/// JSON of more cells is too large to be of use.
constexpr std::size_t kMostJsonCells = 250'000;

Json number(double value) {
  return std::isfinite(value) ? Json(std::round(value * 1e4) / 1e4) : Json(nullptr);  // a tenth of a millimetre
}

template <class Cells, class Get>
Json plane(const Cells& cells, Get get) {
  Json values = Json::array();
  for (const auto& cell : cells) values.push_back(number(get(cell)));
  return values;
}

/// How cells lead to the coordinates in which files go out.
Json render_output(const GridLayout& layout, const OutputFrame& frame) {
  const CellTransform cells = cell_transform(layout, frame);
  const auto pair = [](const Eigen::Vector2d& value) { return Json{value.x(), value.y()}; };
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  return {{"coordinates", frame.grid   ? "mine_grid"
                          : frame.epsg ? "epsg"
                                       : "site"},
          {"corner_m", pair(cells.corner_m)},
          {"a_column_m", pair(cells.a_column_m)},
          {"a_row_m", pair(cells.a_row_m)},
          {"above_site_m", frame.output_from_local(zero).z() - frame.site_from_local(zero).z()}};
}

HttpAnswer render_json(const SurveyResult& survey, const OutputFrame& frame) {
  const Eigen::Vector3d& origin_m = frame.origin_m;
  const GridLayout& layout = survey.before_model.layout;
  if (layout.cell_count() > kMostJsonCells) {
    throw InvalidInput("The grid has too many cells for JSON.", {{"format", "must be bin for more than 250000 cells"}});
  }
  const auto height = [&](const ElevationCell& cell) { return cell.height_m + origin_m.z(); };
  return json_answer({{"corner_m", {layout.origin_m.x() + origin_m.x(), layout.origin_m.y() + origin_m.y()}},
                      {"cell_m", layout.cell_m},
                      {"columns", layout.columns},
                      {"rows", layout.rows},
                      {"output", render_output(layout, frame)},
                      {"rise_m", plane(survey.difference, [](const DifferenceCell& c) { return c.rise_m; })},
                      {"lod95_m", plane(survey.difference,
                                        [](const DifferenceCell& c) { return c.seen() ? c.lod95_m : std::nan(""); })},
                      {"before_m", plane(survey.before_model.cells, height)},
                      {"after_m", plane(survey.after_model.cells, height)}});
}

class Bytes {
 public:
  template <class T>
  void add(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text_.append(bytes, sizeof value);
  }
  void add_text(std::string_view text) { text_ += text; }
  template <class Cells, class Get>
  void add_plane(const Cells& cells, Get get) {
    for (const auto& cell : cells) add(static_cast<float>(get(cell)));
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

HttpAnswer render_bin(const SurveyResult& survey, const Eigen::Vector3d& origin_m) {
  const GridLayout& layout = survey.before_model.layout;
  Bytes out;
  out.add_text("RWDG");
  out.add(std::uint32_t{1});
  out.add(layout.columns);
  out.add(layout.rows);
  out.add(layout.origin_m.x() + origin_m.x());
  out.add(layout.origin_m.y() + origin_m.y());
  out.add(origin_m.z());
  out.add(layout.cell_m);
  out.add_plane(survey.difference, [](const DifferenceCell& c) { return c.rise_m; });
  out.add_plane(survey.difference, [](const DifferenceCell& c) { return c.seen() ? c.lod95_m : std::nan(""); });
  out.add_plane(survey.before_model.cells, [](const ElevationCell& c) { return c.height_m; });
  out.add_plane(survey.after_model.cells, [](const ElevationCell& c) { return c.height_m; });
  HttpAnswer answer;
  answer.content_type = "application/octet-stream";
  answer.body = out.take();
  return answer;
}

}  // namespace

HttpAnswer get_survey_grid(Call& call) {
  const auto format = call.query.parsed("format", parse_grid_format).value_or(GridFormat::json);
  call.query.finish();
  const auto id = id_in_path<SurveyId>(call.path[0]);
  OutputFrame frame;
  const SurveyRecord record = call.services.store.read([&](const Snapshot& snapshot) {
    SurveyRecord found = survey_with(snapshot, id);
    frame = output_frame(site_with(snapshot, found.site));
    return found;
  });
  SurveyResult survey;
  read_models(call.services.store.payloads(), record.models, survey);
  return with_body_tag(format == GridFormat::json ? render_json(survey, frame) : render_bin(survey, frame.origin_m),
                       call.header("If-None-Match"));
}

}  // namespace raywatch::endpoints
