#include "server/settings.hpp"

#include <array>

#include "config/config_reader.hpp"
#include "server/settings_check.hpp"

namespace raywatch {
namespace {

void bind_storage(ConfigReader& reader, DaemonConfig& config) {
  reader.path("storage.data_dir", config.data_dir);
  reader.mebibytes("storage.min_free_disk_mib", config.min_free_disk_bytes, {});
}

void bind_retention(ConfigReader& reader, RetentionConfig& retention) {
  RetentionLimits& limits = retention.defaults;
  std::uint64_t max_age_days = 0, max_bytes = 0, min_free_bytes = 0;
  reader.whole("retention.max_age_days", max_age_days, {.min = 0, .max = 36'500});
  reader.mebibytes("retention.max_mib", max_bytes, {});
  reader.mebibytes("retention.min_free_mib", min_free_bytes, {});
  reader.duration("retention.events_max_age_days", retention.events_max_age, {.min = 1, .max = 36'500});
  limits = {.max_age_days = max_age_days, .max_bytes = max_bytes, .min_free_bytes = min_free_bytes};
}

void bind_http(ConfigReader& reader, HttpConfig& config) {
  reader.text("http.host", config.host);
  reader.whole("http.port", config.port, {});
  reader.flag("http.allow_remote", config.allow_remote);
  reader.whole("http.threads", config.threads, {.min = 2, .max = 1024});
  reader.mebibytes("http.max_body_mib", config.max_body_bytes, {.min = 1, .max = 4096});
  reader.whole("http.max_wait_s", config.max_wait_s, {.min = 0, .max = 3600});
  reader.duration("http.idle_timeout_ms", config.idle_timeout, {.min = 1, .max = 3'600'000});
  reader.duration("http.stall_timeout_ms", config.stall_timeout, {.min = 1, .max = 3'600'000});
  reader.whole("http.min_client_bytes_per_s", config.min_client_bytes_per_s, {});
}

void bind_dashboard(ConfigReader& reader, HttpConfig& config) {
  reader.path("dashboard.directory", config.dashboard_dir);
}

void bind_ingest(ConfigReader& reader, DaemonConfig& config) {
  reader.whole("ingest.queue_limit", config.queue_limit, {.min = 1, .max = 1'000'000});
  reader.duration("ingest.future_tolerance_s", config.future_tolerance, {.min = 0, .max = 86'400});
}

constexpr std::array<std::string_view, 2> kTimesFrom{"name", "mtime"};

FolderConfig read_folder(ConfigReader& reader, const std::string& table) {
  FolderConfig folder;
  std::string time_from{kTimesFrom[0]};
  reader.path(table + ".path", folder.path);
  reader.text(table + ".sensor", folder.sensor);
  reader.text(table + ".site", folder.site);
  reader.flag(table + ".create", folder.create);
  reader.one_of(table + ".time_from", time_from, kTimesFrom);
  reader.duration(table + ".poll_ms", folder.poll, {.min = 100, .max = 3'600'000});
  reader.duration(table + ".settle_ms", folder.settle, {.min = 0, .max = 3'600'000});
  reader.duration(table + ".patience_s", folder.patience, {.min = 0, .max = 86'400});
  folder.time_from = time_from == kTimesFrom[0] ? TimeFrom::name : TimeFrom::mtime;
  reader.require(table + ".path");
  return folder;
}

void bind_folders(ConfigReader& reader, std::vector<FolderConfig>& folders) {
  for (const std::string& table : reader.tables("ingest.folder")) folders.push_back(read_folder(reader, table));
}

void bind_compare(ConfigReader& reader, DaemonConfig& config) {
  reader.whole("compare.workers", config.workers, {.min = 0, .max = 256});
  reader.whole("compare.threads", config.compare_threads, {.min = 0, .max = 256});
  reader.mebibytes("compare.index_cache_mib", config.index_cache_bytes, {});
  reader.duration("compare.previous_limit_h", config.previous_limit, {.min = 1, .max = 876'000});
}

void bind_choice(ConfigReader& reader, ChoiceParameters& choice) {
  reader.whole("priors.max_priors", choice.max_priors, {.min = 1, .max = 64});
  reader.whole("priors.sample_points", choice.sample_points, {.min = 100, .max = 100'000});
  reader.real("priors.min_overlap", choice.min_overlap, {.min = 0.0, .max = 1.0});
  reader.real("priors.repeat_weight", choice.repeat_weight, {.min = 0.0, .max = 1.0});
}

void bind_watch(ConfigReader& reader, WatchConfig& watch) {
  reader.whole("watch.learn_scans", watch.learn_scans, {.min = 1, .max = 1000});
  reader.real("watch.learn_below_testable", watch.learn_below_testable, {.min = 0.0, .max = 1.0});
  reader.duration("watch.late_tolerance_s", watch.late_tolerance, {.min = 0, .max = 86'400});
  reader.duration("watch.moved_within_s", watch.moved_within, {.min = 0, .max = 31'536'000});
}

void bind_delivery(ConfigReader& reader, DeliveryConfig& delivery) {
  reader.text("delivery.public_url", delivery.public_url);
  reader.whole("delivery.attempts", delivery.attempts, {.min = 1, .max = 100});
  reader.duration("delivery.give_up_after_h", delivery.give_up_after, {.min = 1, .max = 8760});
  reader.duration("delivery.alarm_after_s", delivery.alarm_after, {.min = 0, .max = 86'400});
  reader.duration("delivery.keep_h", delivery.keep, {.min = 1, .max = 87'600});
  reader.duration("delivery.connect_timeout_ms", delivery.sender.connect_timeout, {.min = 100, .max = 60'000});
  reader.duration("delivery.timeout_ms", delivery.sender.timeout, {.min = 100, .max = 120'000});
  reader.text("delivery.proxy", delivery.sender.proxy);
  reader.text("delivery.ca_file", delivery.sender.ca_file);
}

void bind_log(ConfigReader& reader, LogConfig& config) {
  reader.one_of("log.level", config.level, kLogLevels);
  reader.one_of("log.format", config.format, kLogFormats);
}

void bind_all(ConfigReader& reader, Settings& settings) {
  bind_storage(reader, settings.daemon);
  bind_retention(reader, settings.daemon.retention);
  bind_http(reader, settings.daemon.http);
  bind_dashboard(reader, settings.daemon.http);
  bind_ingest(reader, settings.daemon);
  bind_folders(reader, settings.daemon.folders);
  bind_compare(reader, settings.daemon);
  bind_choice(reader, settings.daemon.choice);
  bind_watch(reader, settings.daemon.watch);
  bind_delivery(reader, settings.daemon.delivery);
  bind_log(reader, settings.log);
}

void apply(const SettingsGiven& given, Settings& settings) {
  DaemonConfig& daemon = settings.daemon;
  daemon.data_dir = given.data_dir.value_or(daemon.data_dir.string());
  daemon.http.host = given.host.value_or(daemon.http.host);
  daemon.http.port = given.port.value_or(daemon.http.port);
  daemon.http.allow_remote = daemon.http.allow_remote || given.allow_remote;
  settings.log.format = given.log_format.value_or(settings.log.format);
  settings.log.level = given.log_level.value_or(settings.log.level);
}

/// Where the value of a key comes from: an option, else the file.
std::string place_of(const std::string& key, const SettingsGiven& given) {
  if (key == "http.host" && given.host) return "--listen";
  if (key == "storage.data_dir" && given.data_dir) return "--data-dir";
  return key;
}

Settings read_all(ConfigReader reader, const SettingsGiven& given) {
  Settings settings;
  bind_all(reader, settings);
  apply(given, settings);
  for (const FieldError& wrong : complaints_about(settings.daemon)) {
    reader.refuse(place_of(wrong.field, given), wrong.message);
  }
  reader.finish();
  return settings;
}

}  // namespace

Settings read_settings(const std::filesystem::path& file, const SettingsGiven& given) {
  return read_all(ConfigReader::open(file), given);
}

Settings parse_settings(std::string_view toml, const std::string& name, const SettingsGiven& given) {
  return read_all(ConfigReader(toml, name), given);
}

SettingsReport compare_with_defaults(std::string_view toml, const std::string& name) {
  ConfigReader reader(toml, name);
  Settings ignored;
  bind_all(reader, ignored);
  return {reader.absent_keys(), reader.changed_keys()};
}

}  // namespace raywatch
