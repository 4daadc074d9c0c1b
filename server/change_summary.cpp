#include "server/change_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "core/error.hpp"

namespace raywatch {
namespace {

using Clock = std::chrono::steady_clock;

/// @throws Error with the server's words when there is nothing.
nlohmann::json get(ServerClient& server, const std::string& path) {
  const ServerReply reply = server.get("/api/v1" + path);
  if (!reply.ok()) throw Error(reply.problem());
  return nlohmann::json::parse(reply.body);
}

bool is_compared(const nlohmann::json& scan) {
  return std::ranges::all_of(scan.at("comparisons"), [](const nlohmann::json& comparison) {
    const std::string state = comparison.at("state");
    return state == "done" || state == "failed";
  });
}

/// "2 added, 1 removed".
std::string kinds_of(const nlohmann::json& changes) {
  std::map<std::string, std::size_t> counts;
  for (const nlohmann::json& change : changes.at("items")) ++counts[change.at("kind")];
  std::string text;
  for (const auto& [kind, count] : counts) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  return changes.at("next").is_null() ? text : text + ", and more";
}

/// @param id of the comparison with what was before; null when there is none
std::string outcome_of(ServerClient& server, const nlohmann::json& id) {
  if (id.is_null()) return "not compared";
  const nlohmann::json comparison = get(server, "/comparisons/" + id.dump());
  if (comparison.at("state") == "failed")
    return "its comparison failed: " + comparison.at("failure").get<std::string>();
  if (comparison.at("priors").empty()) return "no earlier scan to compare it with";
  const std::string judged =
      " (" + std::to_string(std::lround(100.0 * comparison.at("testable").get<double>())) + " % could be judged)";
  if (comparison.at("changes") == 0) return "nothing changed" + judged;
  return kinds_of(get(server, "/comparisons/" + id.dump() + "/changes?limit=1000")) + judged;
}

/// What is known about a scan when `end` comes, or before.
std::string outcome_until(ServerClient& server, std::int64_t id, Clock::time_point end) {
  for (;;) {
    const nlohmann::json scan = get(server, "/scans/" + std::to_string(id));
    if (is_compared(scan)) return outcome_of(server, scan.at("comparison"));
    if (Clock::now() >= end) return "still being compared";
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

}  // namespace

void report_changes(ServerClient& server, const std::vector<UploadedScan>& scans, std::chrono::seconds patience,
                    const UploadReport& report) {
  const auto end = Clock::now() + patience;
  for (const UploadedScan& scan : scans) {
    report(scan.file.string() + ", scan " + std::to_string(scan.id) + ": " + outcome_until(server, scan.id, end));
  }
}

}  // namespace raywatch
