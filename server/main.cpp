#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "core/error.hpp"
#include "server/commands/commands.hpp"

namespace raywatch {
namespace {

constexpr const char* kFooter = R"(
`raywatch COMMAND --help` says more about each, with examples.
Exit codes of every command: 0 done, 1 failed, 2 wrong arguments or input.)";

int fail(const std::exception& error, ExitCode code) {
  std::cerr << "raywatch: " << error.what() << '\n';
  return code;
}

int run_program(int argc, char** argv) {
  CLI::App program("Watches places with LiDAR and says what has changed.", "raywatch");
  Run run;
  program.set_version_flag("--version", "raywatch " RAYWATCH_VERSION);
  program.require_subcommand(1);
  program.footer(kFooter);
  add_serve(program, run);
  add_ingest(program, run);
  add_compare(program, run);
  add_check_config(program, run);
  add_backup(program, run);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& parsed) {
    return program.exit(parsed) == 0 ? kExitDone : kExitUsage;  // --help and --version come here too
  }
  return run();
}

}  // namespace
}  // namespace raywatch

int main(int argc, char** argv) {
  using namespace raywatch;
  try {
    return run_program(argc, argv);
  } catch (const InvalidInput& error) {
    return fail(error, kExitUsage);
  } catch (const UnsupportedFormat& error) {
    return fail(error, kExitUsage);
  } catch (const TooLarge& error) {
    return fail(error, kExitUsage);
  } catch (const std::exception& error) {
    return fail(error, kExitFailed);
  }
}
