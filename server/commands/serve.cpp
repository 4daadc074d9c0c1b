#include <pthread.h>
#include <spdlog/spdlog.h>
#include <csignal>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "server/commands/commands.hpp"
#include "server/daemon.hpp"
#include "server/log.hpp"
#include "server/machine.hpp"
#include "server/settings.hpp"

namespace raywatch {
namespace {

constexpr const char* kServeFooter = R"(
Options win over the configuration file. There are no accounts: other addresses than loopback need --allow-remote.
Stops cleanly on SIGTERM and SIGINT. Nothing that was answered with 201 is lost, however it ends.

Examples:
  raywatch serve --data-dir /var/lib/raywatch
  raywatch serve --config raywatch.toml --listen 127.0.0.1:9000 --log-format json

Exit codes: 0 stopped by a signal, 1 could not start or go on, 2 wrong arguments or configuration.)";

struct ServeOptions {
  std::string config;
  std::optional<std::string> listen;
  SettingsGiven given;
};

/// "127.0.0.1:8420", "[::1]:8420", "localhost:0".
void set_address(const std::string& listen, SettingsGiven& given) {
  const std::size_t colon = listen.rfind(':');
  const std::string port = colon == std::string::npos ? "" : listen.substr(colon + 1);
  std::uint16_t number = 0;
  const auto read = std::from_chars(port.data(), port.data() + port.size(), number);
  if (port.empty() || colon == 0 || read.ec != std::errc{} || read.ptr != port.data() + port.size()) {
    throw InvalidInput("--listen " + listen + ": must be HOST:PORT, such as 127.0.0.1:8420");
  }
  const std::string host = listen.substr(0, colon);
  given.host = host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
  given.port = number;
}

/// The dashboard that lies beside the program, as it is built or installed; empty when there is none.
std::filesystem::path dashboard_beside_program() {
  for (const char* place : {"web", "../share/raywatch/web"}) {
    const std::filesystem::path directory = (program_dir() / place).lexically_normal();
    if (std::filesystem::is_regular_file(directory / "index.html")) return directory;
  }
  return {};
}

Settings settings_of(const ServeOptions& options) {
  SettingsGiven given = options.given;
  if (options.listen) set_address(*options.listen, given);
  Settings settings =
      options.config.empty() ? parse_settings("", "options", given) : read_settings(options.config, given);
  if (settings.daemon.http.dashboard_dir.empty()) settings.daemon.http.dashboard_dir = dashboard_beside_program();
  return settings;
}

/// The signals that stop the daemon, blocked in this thread and all that it starts, so that one place waits for them.
sigset_t block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a client that goes away is no reason to die
  return signals;
}

std::string url_of(const HttpConfig& http, std::uint16_t port) {
  const std::string host = http.host.find(':') == std::string::npos ? http.host : "[" + http.host + "]";
  return "http://" + host + ":" + std::to_string(port);
}

int run_serve(const ServeOptions& options) {
  const Settings settings = settings_of(options);
  const sigset_t stop_signals = block_stop_signals();
  start_log(settings.log);
  return_large_blocks();
  Daemon daemon(settings.daemon);
  spdlog::info("listening on {}, data in {}", url_of(settings.daemon.http, daemon.port()),
               std::filesystem::absolute(settings.daemon.data_dir).string());
  if (settings.daemon.http.dashboard_dir.empty()) spdlog::warn("there is no dashboard: scripts/build makes it");
  int signal = 0;
  sigwait(&stop_signals, &signal);
  spdlog::info("stopping on {}", signal == SIGINT ? "SIGINT" : "SIGTERM");
  if (const StopOutcome outcome = daemon.stop(); outcome != StopOutcome::clean) {
    spdlog::warn("a {} did not end in time; it is put back and starts again at the next start",
                 outcome == StopOutcome::comparisons_abandoned ? "comparison or a survey" : "message");
    spdlog::shutdown();
    std::_Exit(kExitDone);  // its thread cannot be stopped, and the store is safe whenever the process ends
  }
  spdlog::info("stopped");
  return kExitDone;
}

}  // namespace

void add_serve(CLI::App& program, Run& run) {
  CLI::App* command = program.add_subcommand("serve", "Run the daemon");
  const auto options = std::make_shared<ServeOptions>();
  command->footer(kServeFooter);
  command->add_option("--config", options->config, "Settings; see config/raywatch.toml for all of them")
      ->type_name("FILE");
  command->add_option("--data-dir", options->given.data_dir, "Where everything is kept (default: raywatch-data)")
      ->type_name("DIR");
  command->add_option("--listen", options->listen, "Where to listen (default: 127.0.0.1:8420); port 0: any free one")
      ->type_name("HOST:PORT");
  command->add_flag("--allow-remote", options->given.allow_remote,
                    "Listen on an address that other machines can reach");
  command->add_option("--log-format", options->given.log_format, "human (default) or json")
      ->check(CLI::IsMember({"human", "json"}));
  command->add_option("--log-level", options->given.log_level, "trace, debug, info (default), warning, error or off")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error", "off"}));
  command->callback([&run, options] { run = [options] { return run_serve(*options); }; });
}

}  // namespace raywatch
