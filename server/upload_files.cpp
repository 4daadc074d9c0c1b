#include "server/upload_files.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/time.hpp"
#include "server/folder_files.hpp"
#include "storage/formats/side_car.hpp"

namespace raywatch {
namespace {

namespace fs = std::filesystem;

void add_directory(const fs::path& directory, std::vector<fs::path>& files) {
  const std::size_t before = files.size();
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file() && has_scan_ending(entry.path())) files.push_back(entry.path());
  }
  if (files.size() == before) throw InvalidInput(directory.string() + ": holds no scan file");
}

/// A file that is broken is reported when it is its turn, not here.
std::optional<Time> side_car_time(const fs::path& file) {
  try {
    return read_side_car(file).captured_at;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string pose_text(const Pose& pose) {
  std::ostringstream text;
  text.precision(17);
  const Eigen::Vector3d& p = pose.position_m;
  const Eigen::Quaterniond& q = pose.orientation;
  text << p.x() << ',' << p.y() << ',' << p.z() << ',' << q.x() << ',' << q.y() << ',' << q.z() << ',' << q.w();
  return text.str();
}

/// What goes with a file. The format as well: the server does not hear of the file's name.
ServerClient::Query query_of(const fs::path& file, const ScanHints& hints, const std::string& sensor,
                             const UploadOptions& options) {
  ServerClient::Query query = {{"sensor", sensor}};
  if (hints.captured_at) query.emplace_back("captured_at", format_rfc3339(*hints.captured_at));
  if (hints.pose) query.emplace_back("pose", pose_text(*hints.pose));
  if (hints.frame) query.emplace_back("frame", *hints.frame == Frame::world ? "world" : "sensor");
  query.emplace_back("format", options.format ? *options.format : std::string(to_string(scan_format_of(file))));
  return query;
}

/// Makes one thing of the server; that it is there already is as good.
void create(ServerClient& server, const std::string& path, const nlohmann::json& what) {
  const ServerReply reply = server.post_json(path, what.dump());
  if (!reply.ok() && reply.status != 409) throw Error(path + ": " + reply.problem());
}

/// Sees to it that uploads of `sensor` can be accepted.
void prepare_sensor(ServerClient& server, const std::string& sensor, const UploadOptions& options) {
  const ServerReply found = server.get("/api/v1/sensors/" + path_segment(sensor));
  const nlohmann::json answer = nlohmann::json::parse(found.body, nullptr, false);
  if (!answer.is_object()) throw Error("what answers is no raywatch daemon; --server names another address");
  if (found.ok()) {
    const std::string site = answer.value("site", "");
    if (options.site && site != *options.site) {
      throw Error("sensor \"" + sensor + "\" belongs to the site \"" + site + "\", not to \"" + *options.site + "\"");
    }
    return;
  }
  if (found.status != 404) throw Error("sensor \"" + sensor + "\": " + found.problem());
  if (!options.create) throw Error("there is no sensor \"" + sensor + "\"; --create with --site makes it");
  if (!options.site) throw InvalidInput("--create needs --site, the site that the sensor belongs to");
  nlohmann::json site = {{"name", *options.site}};
  if (options.profile) site["profile"] = *options.profile;
  create(server, "/api/v1/sites", site);
  create(server, "/api/v1/sensors", {{"name", sensor}, {"site", *options.site}});
}

/// Sends one file, again and again while the server says that it is busy, or is away, as long as there is patience.
ServerReply send_patiently(ServerClient& server, const fs::path& file, const ServerClient::Query& query,
                           const UploadOptions& options, const UploadReport& report) {
  const auto give_up = std::chrono::steady_clock::now() + options.patience;
  const auto must_give_up = [&](std::chrono::seconds pause) {
    return std::chrono::steady_clock::now() + pause > give_up;
  };
  for (;;) {
    std::chrono::seconds pause{1};
    try {
      ServerReply reply = server.post_file("/api/v1/scans", query, file);
      pause = std::clamp(reply.retry_after.value_or(pause), std::chrono::seconds(1), std::chrono::seconds(60));
      if (reply.status != 503 || must_give_up(pause)) return reply;
      report(file.string() + ": the server is busy; trying again in " + std::to_string(pause.count()) + " s");
    } catch (const Error& error) {
      if (must_give_up(pause)) throw;
      report(file.string() + ": " + error.what() + "; trying again");
    }
    std::this_thread::sleep_for(pause);
  }
}

/// The ids in the answer to an upload: one scan, or a list of them.
std::vector<std::int64_t> scan_ids(const std::string& body) {
  const nlohmann::json json = nlohmann::json::parse(body);
  if (json.contains("id")) return {json["id"].get<std::int64_t>()};
  std::vector<std::int64_t> ids;
  for (const nlohmann::json& scan : json.at("items")) ids.push_back(scan.at("id").get<std::int64_t>());
  return ids;
}

std::string shown(const std::vector<std::int64_t>& ids) {
  std::string text = ids.size() == 1 ? "scan " : "scans ";
  for (std::size_t i = 0; i < ids.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(ids[i]);
  return text;
}

/// Sees to it that somebody answers; a daemon that was just started needs a moment.
void meet_daemon(ServerClient& server, const UploadOptions& options, const UploadReport& report) {
  constexpr std::chrono::seconds kFirstContact{10};
  const auto patience = std::min(options.patience, kFirstContact);
  const auto give_up = std::chrono::steady_clock::now() + patience;
  for (bool is_first = true;; is_first = false) {
    try {
      server.get("/healthz");
      return;
    } catch (const Unreachable& error) {
      if (std::chrono::steady_clock::now() >= give_up) throw;
      if (is_first) report(error.what() + ("; waiting for up to " + std::to_string(patience.count()) + " s"));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

class Uploader {
 public:
  Uploader(ServerClient& server, const UploadOptions& options, const UploadReport& report)
      : server_(server), options_(options), report_(report) {
    if (options_.sensor) prepare(*options_.sensor);
  }

  void upload(const fs::path& file, const std::string& place) {
    try {
      const ScanHints hints = read_side_car(file);
      const std::string sensor = sensor_of(file, hints);
      prepare(sensor);
      const ServerReply reply =
          send_patiently(server_, file, query_of(file, hints, sensor, options_), options_, report_);
      if (!reply.ok()) throw Error(reply.problem());
      const bool is_new = reply.status == 201;
      ++(is_new ? summary_.stored : summary_.already_there);
      const std::vector<std::int64_t> ids = scan_ids(reply.body);
      for (const std::int64_t id : ids) summary_.scans.push_back({file, id});
      report_(place + file.string() + (is_new ? ": stored as " : ": already there, ") + shown(ids));
    } catch (const std::exception& error) {
      ++summary_.failed;
      report_(place + file.string() + ": failed: " + error.what());
    }
  }

  const UploadSummary& summary() const { return summary_; }

 private:
  void prepare(const std::string& sensor) {
    if (prepared_.contains(sensor)) return;
    prepare_sensor(server_, sensor, options_);
    prepared_.insert(sensor);
  }

  std::string sensor_of(const fs::path& file, const ScanHints& hints) const {
    if (options_.sensor) return *options_.sensor;
    if (hints.sensor) return *hints.sensor;
    throw InvalidInput("no sensor: neither --sensor nor " + file.string() + ".json names it");
  }

  ServerClient& server_;
  const UploadOptions& options_;
  const UploadReport& report_;
  std::set<std::string> prepared_;
  UploadSummary summary_;
};

}  // namespace

std::vector<fs::path> find_scan_files(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (fs::is_directory(path)) {
      add_directory(path, files);
    } else if (fs::is_regular_file(path)) {
      files.push_back(path);
    } else {
      throw InvalidInput(path.string() + ": there is no such file or directory");
    }
  }
  std::vector<std::pair<Time, fs::path>> by_time;
  for (const fs::path& file : files) by_time.emplace_back(side_car_time(file).value_or(Time::max()), file);
  std::ranges::sort(by_time);
  std::ranges::transform(by_time, files.begin(), [](const auto& item) { return item.second; });
  return files;
}

UploadSummary upload_files(ServerClient& server, const std::vector<fs::path>& files, const UploadOptions& options,
                           const UploadReport& report) {
  meet_daemon(server, options, report);
  Uploader uploader(server, options, report);
  for (std::size_t i = 0; i < files.size(); ++i) {
    uploader.upload(files[i], "[" + std::to_string(i + 1) + "/" + std::to_string(files.size()) + "] ");
  }
  return uploader.summary();
}

}  // namespace raywatch
