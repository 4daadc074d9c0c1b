#include "storage/site_crs.hpp"

#include <proj.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "storage/shared_library.hpp"

namespace raywatch {
namespace {

/// The functions of PROJ that are used, with the types of its header.
struct Proj {
  decltype(&proj_context_create) context_create;
  decltype(&proj_context_destroy) context_destroy;
  decltype(&proj_log_level) log_level;
  decltype(&proj_create) create;
  decltype(&proj_destroy) destroy;
  decltype(&proj_get_type) get_type;
  decltype(&proj_get_name) get_name;
  decltype(&proj_crs_get_sub_crs) crs_get_sub_crs;
  decltype(&proj_crs_get_coordinate_system) crs_get_coordinate_system;
  decltype(&proj_cs_get_axis_info) cs_get_axis_info;
  decltype(&proj_as_wkt) as_wkt;
  decltype(&proj_create_crs_to_crs) create_crs_to_crs;
  decltype(&proj_normalize_for_visualization) normalize_for_visualization;
  decltype(&proj_trans) trans;

  Proj() {
    const SharedLibrary library({.soname = "libproj.so.25", .package = "libproj25"});
    library.find(context_create, "proj_context_create");
    library.find(context_destroy, "proj_context_destroy");
    library.find(log_level, "proj_log_level");
    library.find(create, "proj_create");
    library.find(destroy, "proj_destroy");
    library.find(get_type, "proj_get_type");
    library.find(get_name, "proj_get_name");
    library.find(crs_get_sub_crs, "proj_crs_get_sub_crs");
    library.find(crs_get_coordinate_system, "proj_crs_get_coordinate_system");
    library.find(cs_get_axis_info, "proj_cs_get_axis_info");
    library.find(as_wkt, "proj_as_wkt");
    library.find(create_crs_to_crs, "proj_create_crs_to_crs");
    library.find(normalize_for_visualization, "proj_normalize_for_visualization");
    library.find(trans, "proj_trans");
  }
};

const Proj& proj() {
  static const Proj functions;
  return functions;
}

/// What is wrong is said by exceptions, not on the standard error of the daemon.
struct Context {
  PJ_CONTEXT* context = proj().context_create();
  Context() { proj().log_level(context, PJ_LOG_NONE); }
  ~Context() { proj().context_destroy(context); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

struct DestroyPj {
  void operator()(PJ* object) const { proj().destroy(object); }
};
using PjPtr = std::unique_ptr<PJ, DestroyPj>;

std::string code_of(int epsg) { return "EPSG:" + std::to_string(epsg); }

[[noreturn]] void refuse(int epsg, const std::string& why) {
  throw InvalidInput("The coordinate reference system " + code_of(epsg) + " cannot be used.", {{"epsg", why}});
}

}  // namespace

CrsInfo describe_crs(int epsg) {
  const Context context;
  const PjPtr crs(proj().create(context.context, code_of(epsg).c_str()));
  if (!crs) refuse(epsg, "is no code that PROJ knows; see epsg.org, for example 25833 for ETRS89 / UTM zone 33N");
  CrsInfo info{.epsg = epsg, .name = proj().get_name(crs.get())};
  const bool compound = proj().get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS;
  const PjPtr part(compound ? proj().crs_get_sub_crs(context.context, crs.get(), 0) : nullptr);
  const PJ* const horizontal = compound ? part.get() : crs.get();
  info.projected = horizontal != nullptr && proj().get_type(horizontal) == PJ_TYPE_PROJECTED_CRS;
  const PjPtr axes(horizontal != nullptr ? proj().crs_get_coordinate_system(context.context, horizontal) : nullptr);
  if (!axes) refuse(epsg, "is no coordinate reference system");
  double factor = 0.0;
  const char* unit = "";
  proj().cs_get_axis_info(context.context, axes.get(), 0, nullptr, nullptr, nullptr, &factor, &unit, nullptr, nullptr);
  info.unit = unit;
  if (info.projected) info.metres_a_unit = factor;
  const std::array<const char*, 2> options{"MULTILINE=NO", nullptr};
  const char* const wkt = proj().as_wkt(context.context, crs.get(), PJ_WKT1_GDAL, options.data());
  if (wkt != nullptr) info.wkt = wkt;
  return info;
}

void require_metric(const CrsInfo& crs) {
  if (!crs.projected) {
    refuse(crs.epsg, crs.name + " is not projected (its unit is the " + crs.unit +
                         "): lengths and volumes need a projected one, such as a UTM zone");
  }
  if (crs.metres_a_unit != 1.0) {
    refuse(crs.epsg, crs.name + " is in the unit " + crs.unit + "; sites are in metres, choose one that is, too");
  }
}

struct ToWgs84::Transformation {
  Context context;
  PjPtr operation;
};

ToWgs84::ToWgs84(int epsg) : transformation_(std::make_unique<Transformation>()) {
  PJ_CONTEXT* const context = transformation_->context.context;
  const PjPtr plain(proj().create_crs_to_crs(context, code_of(epsg).c_str(), "OGC:CRS84", nullptr));
  if (plain) transformation_->operation.reset(proj().normalize_for_visualization(context, plain.get()));
  if (!transformation_->operation) refuse(epsg, "is no code from which PROJ leads to WGS 84");
}

ToWgs84::~ToWgs84() = default;
ToWgs84::ToWgs84(ToWgs84&&) noexcept = default;
ToWgs84& ToWgs84::operator=(ToWgs84&&) noexcept = default;

Eigen::Vector2d ToWgs84::longitude_latitude_deg(const Eigen::Vector2d& easting_northing) const {
  const PJ_COORD from = {{easting_northing.x(), easting_northing.y(), 0.0, HUGE_VAL}};
  const PJ_COORD to = proj().trans(transformation_->operation.get(), PJ_FWD, from);
  if (!std::isfinite(to.xy.x) || !std::isfinite(to.xy.y)) {
    throw InvalidInput(
        "A place lies outside of where the site's coordinate reference system holds; is the origin of "
        "the site right?",
        {{"origin_m", "leads to a place that PROJ cannot transform"}});
  }
  return {to.xy.x, to.xy.y};
}

}  // namespace raywatch
