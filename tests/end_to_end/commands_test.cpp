#include <doctest/doctest.h>

#include <fstream>

#include "tests/end_to_end/process.hpp"
#include "tests/support/temp_dir.hpp"

using namespace raywatch::test;

TEST_CASE("every command has help with an example and its exit codes") {
  for (const char* command : {"serve", "ingest", "compare", "check-config", "backup"}) {
    CAPTURE(command);
    const Ended help = run_raywatch({command, "--help"});
    CHECK(help.exit_code == 0);
    CHECK(help.out.find(std::string("raywatch ") + command) != std::string::npos);
    CHECK(help.out.find("Exit codes: 0") != std::string::npos);
  }
  const Ended help = run_raywatch({"--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.out.find("serve") != std::string::npos);
}

TEST_CASE("the version is told") {
  const Ended version = run_raywatch({"--version"});
  CHECK(version.exit_code == 0);
  CHECK(version.out.find("raywatch 0.") == 0);
}

TEST_CASE("wrong arguments end with 2 and say what is wrong") {
  CHECK(run_raywatch({}).exit_code == 2);
  CHECK(run_raywatch({"fly"}).exit_code == 2);
  const Ended wrong = run_raywatch({"serve", "--lisen", "127.0.0.1:0"});
  CHECK(wrong.exit_code == 2);
  CHECK(wrong.err.find("--lisen") != std::string::npos);
}

TEST_CASE("check-config tells every error of a file with its line, and the daemon does not start with it") {
  const raywatch::TempDir folder;
  const std::string file = (folder.path() / "raywatch.toml").string();
  std::ofstream(file) << "[http]\nprot = 8420\nthreads = 1\n[log]\nlevel = 'loud'\n";
  const Ended checked = run_raywatch({"check-config", file});
  CHECK(checked.exit_code == 1);
  CHECK(checked.out.find("http.prot, line 2: unknown key; did you mean http.port?") != std::string::npos);
  CHECK(checked.out.find("http.threads, line 3: must be 2 to 1024, not 1") != std::string::npos);
  CHECK(checked.out.find("log.level, line 5: must be one of") != std::string::npos);

  const Ended served = run_raywatch({"serve", "--config", file, "--data-dir", (folder.path() / "data").string()});
  CHECK(served.exit_code == 2);
  CHECK(served.err.find("http.prot, line 2") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "data"));
}

TEST_CASE("check-config refuses what the daemon would not start with") {
  const raywatch::TempDir folder;
  const std::string file = (folder.path() / "raywatch.toml").string();
  std::ofstream(file) << "[http]\nhost = '0.0.0.0'\nport = 0\n[dashboard]\ndirectory = '/nope'\n";
  const Ended checked = run_raywatch({"check-config", file});
  const Ended served = run_raywatch({"serve", "--config", file, "--data-dir", (folder.path() / "data").string()});
  CHECK(checked.exit_code == 1);
  CHECK(checked.out.find("http.host, line 2: ") != std::string::npos);
  CHECK(checked.out.find("dashboard.directory, line 5: ") != std::string::npos);
  CHECK(served.exit_code == 2);
  CHECK(served.err == "raywatch: " + checked.out);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "data"));
}

TEST_CASE("check-config is content with the example") {
  const Ended checked = run_raywatch({"check-config", RAYWATCH_SOURCE_DIR "/config/raywatch.toml"});
  CHECK(checked.exit_code == 0);
}
