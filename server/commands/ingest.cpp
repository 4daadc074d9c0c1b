#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/change_summary.hpp"
#include "server/commands/commands.hpp"
#include "server/commands/number_options.hpp"
#include "server/upload_files.hpp"

namespace raywatch {
namespace {

constexpr const char* kIngestFooter = R"(
What a file does not say itself (capture time, pose, frame, sensor) is taken from FILE.json beside it:
  {"captured_at": "2026-03-01T02:10:00Z", "frame": "sensor",
   "pose": {"position_m": [0, 0, 1.5], "orientation_xyzw": [0, 0, 0, 1]}}
A capture time and a pose are needed for every file; the pose may also be the sensor's own.
Files are sent in the order of their capture times. Repeating is safe: what is already there stays as it is.
A server that does not answer at first is waited for, 10 seconds at most. While it is busy, or away for a moment, a
file is tried again. With --wait what changed is printed, a line a scan; the exit code does not depend on that.

Examples:
  raywatch ingest lastnight.pcd tonight.pcd --sensor gate-1 --site yard --create --wait 60
  raywatch ingest scans/ --server http://127.0.0.1:8420 --sensor gate-1 --site yard --create
  raywatch ingest tonight.pcd --sensor gate-1

Exit codes: 0 all files are on the server, 1 some are not (the summary says which and why), 2 wrong arguments.)";

struct IngestOptions {
  std::vector<std::string> files;
  std::string server = "http://127.0.0.1:8420";
  UploadOptions upload;
  int patience_s = 300;
  std::optional<int> wait_s;
};

int run_ingest(const IngestOptions& options) {
  const std::vector<std::filesystem::path> files = find_scan_files({options.files.begin(), options.files.end()});
  UploadOptions upload = options.upload;
  upload.patience = std::chrono::seconds(options.patience_s);
  ServerClient server(options.server);
  const UploadSummary summary =
      upload_files(server, files, upload, [](const std::string& line) { std::cerr << line << std::endl; });
  std::cout << summary.stored << " stored, " << summary.already_there << " already there, " << summary.failed
            << " failed" << std::endl;
  if (options.wait_s) {
    report_changes(server, summary.scans, std::chrono::seconds(*options.wait_s),
                   [](const std::string& line) { std::cout << line << std::endl; });
  }
  return summary.failed == 0 ? kExitDone : kExitFailed;
}

}  // namespace

void add_ingest(CLI::App& program, Run& run) {
  CLI::App* command = program.add_subcommand("ingest", "Upload scan files to a running daemon");
  const auto options = std::make_shared<IngestOptions>();
  command->footer(kIngestFooter);
  command->add_option("files", options->files, "Scan files, or directories of them")->required()->type_name("FILE");
  command->add_option("--server", options->server, "The daemon's address")->type_name("URL")->capture_default_str();
  command->add_option("--sensor", options->upload.sensor, "What took the scans; else the side-cars say so")
      ->type_name("NAME");
  command->add_option("--site", options->upload.site, "The sensor's site")->type_name("NAME");
  command->add_flag("--create", options->upload.create, "Make the site and the sensor when they are missing");
  command->add_option("--profile", options->upload.profile, "Of a site that is made")
      ->check(CLI::IsMember({"indoor", "outdoor", "survey"}));
  command->add_option("--format", options->upload.format,
                      "pcd, ply, las, ptx, text or kitti; else decided from the file");
  command->add_option("--patience-s", options->patience_s, "How long one file is tried again while the server is busy")
      ->check(within(IntegerBounds{.min = 0, .max = 86'400}))
      ->capture_default_str();
  command
      ->add_option("--wait", options->wait_s,
                   "Wait so many seconds for the comparisons of these scans, and say what changed")
      ->check(within(IntegerBounds{.min = 0, .max = 86'400}))
      ->type_name("SECONDS");
  command->callback([&run, options] { run = [options] { return run_ingest(*options); }; });
}

}  // namespace raywatch
