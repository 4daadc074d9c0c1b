#include "api/render.hpp"

namespace raywatch {

Json render(const RetentionLimits& limits) {
  return {{"max_age_days", json_or_null(limits.max_age_days)},
          {"max_bytes", json_or_null(limits.max_bytes)},
          {"min_free_bytes", json_or_null(limits.min_free_bytes)}};
}

Json render(const Site& site) {
  return {{"name", site.name},
          {"time_zone", site.time_zone},
          {"profile", to_string(site.profile)},
          {"epsg", json_or_null(site.epsg)},
          {"origin_m", site.origin_m ? render(*site.origin_m) : Json(nullptr)},
          {"retention", render(site.retention)},
          {"created_at", format_rfc3339(site.created_at)}};
}

}  // namespace raywatch
