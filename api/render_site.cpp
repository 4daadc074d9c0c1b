#include "api/render.hpp"
#include "api/units.hpp"

namespace raywatch {

Json render(const RetentionLimits& limits) {
  return {{"max_age_days", json_or_null(limits.max_age_days)},
          {"max_bytes", json_or_null(limits.max_bytes)},
          {"min_free_bytes", json_or_null(limits.min_free_bytes)}};
}

namespace {

Json render_grid(const MineGrid& grid) {
  return {{"site_origin_m", render(grid.site_origin_m)},
          {"grid_origin_m", render(grid.grid_origin_m)},
          {"rotation_deg", deg_of_radians(grid.rotation_rad)},
          {"scale", grid.scale}};
}

}  // namespace

Json render(const Site& site) {
  return {{"name", site.name},
          {"time_zone", site.time_zone},
          {"profile", to_string(site.profile)},
          {"epsg", json_or_null(site.epsg)},
          {"mine_grid", site.mine_grid ? render_grid(*site.mine_grid) : Json(nullptr)},
          {"origin_m", site.origin_m ? render(*site.origin_m) : Json(nullptr)},
          {"retention", render(site.retention)},
          {"created_at", format_rfc3339(site.created_at)}};
}

}  // namespace raywatch
