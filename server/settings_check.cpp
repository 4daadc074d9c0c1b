#include "server/settings_check.hpp"

#include <algorithm>
#include <filesystem>
#include <string>

#include "api/channel_rules.hpp"
#include "api/dashboard.hpp"
#include "server/delivery/transfer.hpp"

namespace raywatch {
namespace {

namespace fs = std::filesystem;

struct Complaints {
  std::vector<FieldError> list;

  void require(bool holds, const std::string& key, const std::string& otherwise) {
    if (!holds) list.push_back({key, otherwise});
  }
  /// What `check` refuses is wrong with the key.
  template <class Check>
  void require_accepted(const std::string& key, Check check) {
    try {
      check();
    } catch (const InvalidInput& error) {
      list.push_back({key, error.what()});
    }
  }
};

void check_storage(const DaemonConfig& config, Complaints& complaints) {
  const fs::path& data_dir = config.data_dir;
  complaints.require(!data_dir.empty(), "storage.data_dir", "must not be empty");
  complaints.require(!fs::exists(data_dir) || fs::is_directory(data_dir), "storage.data_dir", "is no directory");
  const std::uint64_t kept_free_bytes = config.retention.defaults.min_free_bytes.value_or(0);
  complaints.require(kept_free_bytes == 0 || kept_free_bytes > config.min_free_disk_bytes, "retention.min_free_mib",
                     "must be more than storage.min_free_disk_mib, or new scans are refused before any is deleted");
}

void check_http(const HttpConfig& config, Complaints& complaints) {
  if (const auto complaint = complaint_about_host(config)) {
    complaints.require(false, "http.host", "\"" + config.host + "\" " + *complaint);
  }
  if (!config.dashboard_dir.empty()) {
    complaints.require_accepted("dashboard.directory", [&] { Dashboard::read(config.dashboard_dir); });
  }
}

void check_folders(const std::vector<FolderConfig>& folders, Complaints& complaints) {
  std::vector<fs::path> taken;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const std::string key = "ingest.folder[" + std::to_string(i) + "].path";
    complaints.require(!folders[i].path.empty(), key, "must not be empty");
    if (folders[i].path.empty()) continue;
    const fs::path path = fs::weakly_canonical(fs::absolute(folders[i].path / ""));
    const auto first = std::ranges::find(taken, path);
    complaints.require(first == taken.end(), key,
                       "is the folder of ingest.folder[" + std::to_string(first - taken.begin()) + "], too");
    taken.push_back(path);
  }
}

void check_delivery(const DeliveryConfig& config, Complaints& complaints) {
  if (!config.public_url.empty()) {
    complaints.require_accepted("delivery.public_url", [&] { checked_webhook_url(config.public_url); });
  }
  const SenderConfig& sender = config.sender;
  complaints.require(sender.proxy.empty() || is_proxy(sender.proxy), "delivery.proxy",
                     "must be the address of a proxy, such as http://proxy:3128");
  complaints.require(sender.ca_file.empty() || fs::is_regular_file(sender.ca_file), "delivery.ca_file",
                     "there is no file " + sender.ca_file);
}

}  // namespace

std::vector<FieldError> complaints_about(const DaemonConfig& config) {
  Complaints complaints;
  check_storage(config, complaints);
  check_http(config.http, complaints);
  check_folders(config.folders, complaints);
  check_delivery(config.delivery, complaints);
  return complaints.list;
}

}  // namespace raywatch
