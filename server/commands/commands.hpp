#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace raywatch {

/// How the program ends. Scripts may rely on these.
enum ExitCode : int {
  kExitDone = 0,    ///< all was done
  kExitFailed = 1,  ///< it was tried and did not work, in part or as a whole; standard error says what
  kExitUsage = 2,   ///< the arguments or an input file are wrong, so that nothing was tried
};

/// What a chosen subcommand does; gives the exit code. Empty while none is chosen.
using Run = std::function<int()>;

/// @{ Each adds one subcommand with its options and help to the program; `run` is set when it is chosen.
void add_serve(CLI::App& program, Run& run);
void add_ingest(CLI::App& program, Run& run);
void add_compare(CLI::App& program, Run& run);
void add_check_config(CLI::App& program, Run& run);
void add_backup(CLI::App& program, Run& run);
/// @}

}  // namespace raywatch
