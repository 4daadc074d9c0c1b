#include "api/lookup.hpp"

namespace raywatch {
namespace {

template <class Record>
Record required(std::optional<Record> record, const std::string& what) {
  if (!record) throw NotFound("There is no " + what + ".");
  return *std::move(record);
}

std::string quoted_name(std::string_view name) { return "'" + std::string(name.substr(0, 200)) + "'"; }

}  // namespace

Site site_named(const Snapshot& snapshot, std::string_view name) {
  return required(find_site(snapshot, name), "site " + quoted_name(name));
}

Sensor sensor_named(const Snapshot& snapshot, std::string_view name) {
  return required(find_sensor(snapshot, name), "sensor " + quoted_name(name));
}

Site site_with(const Snapshot& snapshot, SiteId id) {
  return required(find_site(snapshot, id), "site with id " + std::to_string(id.value));
}

ScanRecord scan_with(const Snapshot& snapshot, ScanId id) {
  return required(find_scan(snapshot, id), "scan " + std::to_string(id.value));
}

ComparisonRecord comparison_with(const Snapshot& snapshot, ComparisonId id) {
  return required(find_comparison(snapshot, id), "comparison " + std::to_string(id.value));
}

ChangeRecord change_with(const Snapshot& snapshot, ChangeId id) {
  return required(find_change(snapshot, id), "change " + std::to_string(id.value));
}

}  // namespace raywatch
