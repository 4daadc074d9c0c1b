#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "server/commands/commands.hpp"
#include "server/settings.hpp"

namespace raywatch {
namespace {

constexpr const char* kCheckConfigFooter = R"(
Example:
  raywatch check-config /etc/raywatch/raywatch.toml

Exit codes: 0 the file is good, 1 it is not; every error is listed with its line, 2 wrong arguments.)";

int check(const std::string& file) {
  try {
    read_settings(file);
  } catch (const InvalidInput& error) {
    std::cout << error.what() << '\n';
    return kExitFailed;
  }
  std::cout << file << ": good\n";
  return kExitDone;
}

}  // namespace

void add_check_config(CLI::App& program, Run& run) {
  CLI::App* command = program.add_subcommand("check-config", "Say what is wrong in a configuration file, and where");
  const auto file = std::make_shared<std::string>();
  command->footer(kCheckConfigFooter);
  command->add_option("file", *file, "The configuration file")->required()->type_name("FILE");
  command->callback([&run, file] { run = [file] { return check(*file); }; });
}

}  // namespace raywatch
