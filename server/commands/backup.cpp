#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "server/commands/commands.hpp"
#include "server/server_client.hpp"
#include "storage/store.hpp"

namespace raywatch {
namespace {

constexpr const char* kBackupFooter = R"(
The copy is consistent, also while scans arrive. To restore, start a daemon with the copy as its --data-dir.
With --server the running daemon writes the copy, on its own machine. With --data-dir the files are copied directly;
that is refused while a daemon uses them.

Examples:
  raywatch backup /backup/raywatch-2026-03-01 --server http://127.0.0.1:8420
  raywatch backup /backup/raywatch-2026-03-01 --data-dir /var/lib/raywatch

Exit codes: 0 done, 1 failed, 2 wrong arguments.)";

struct BackupOptions {
  std::string output;
  std::string server = "http://127.0.0.1:8420";
  std::string data_dir;
};

void backup_through(const std::string& url, const std::filesystem::path& output) {
  ServerClient server(url);
  const nlohmann::json request = {{"directory", output.string()}};
  const ServerReply reply = server.post_json("/api/v1/backup", request.dump());
  if (!reply.ok()) throw Error(reply.problem());
}

void backup_files(const std::filesystem::path& data_dir, const std::filesystem::path& output) {
  if (!std::filesystem::is_directory(data_dir)) throw InvalidInput(data_dir.string() + ": there is no such directory");
  Store store({.data_dir = data_dir});
  store.backup(output);
}

int run_backup(const BackupOptions& options) {
  const std::filesystem::path output = std::filesystem::absolute(options.output);
  options.data_dir.empty() ? backup_through(options.server, output) : backup_files(options.data_dir, output);
  std::cout << "copied to " << output.string() << '\n';
  return kExitDone;
}

}  // namespace

void add_backup(CLI::App& program, Run& run) {
  CLI::App* command = program.add_subcommand("backup", "Copy a store consistently, also while it is in use");
  const auto options = std::make_shared<BackupOptions>();
  command->footer(kBackupFooter);
  command->add_option("output", options->output, "A new or empty directory")->required()->type_name("OUTPUT_DIR");
  CLI::Option* server =
      command->add_option("--server", options->server, "The daemon's address")->type_name("URL")->capture_default_str();
  command->add_option("--data-dir", options->data_dir, "Copy these files; no daemon may be using them")
      ->type_name("DIR")
      ->excludes(server);
  command->callback([&run, options] { run = [options] { return run_backup(*options); }; });
}

}  // namespace raywatch
