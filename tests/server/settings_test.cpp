#include "server/settings.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "core/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace raywatch {
namespace {

std::string read_example() {
  std::ifstream in(RAYWATCH_SOURCE_DIR "/config/raywatch.toml");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("the example configuration shows every key at its default") {
  const std::string example = read_example();
  REQUIRE_NOTHROW(parse_settings(example, "raywatch.toml"));
  const SettingsReport report = compare_with_defaults(example, "raywatch.toml");
  CHECK(report.absent == std::vector<std::string>{});
  CHECK(report.changed == std::vector<std::string>{});
}

TEST_CASE("settings reach the parts that they belong to") {
  const Settings settings = parse_settings(
      "[storage]\ndata_dir = '/data'\n[http]\nport = 9000\nmax_body_mib = 2\n[priors]\nmax_priors = 2\n"
      "[ingest]\nqueue_limit = 7\n[compare]\nprevious_limit_h = 24\n[log]\nformat = 'json'\n",
      "test.toml");
  CHECK(settings.daemon.data_dir == "/data");
  CHECK(settings.daemon.http.port == 9000);
  CHECK(settings.daemon.http.max_body_bytes == 2u << 20);
  CHECK(settings.daemon.choice.max_priors == 2);
  CHECK(settings.daemon.queue_limit == 7);
  CHECK(settings.daemon.previous_limit == std::chrono::hours(24));
  CHECK(settings.log.format == "json");
}

TEST_CASE("folders are tables of an array, each with a path, and what is wrong in one is said with its place") {
  const Settings settings = parse_settings(
      "[ingest]\nqueue_limit = 7\n[[ingest.folder]]\npath = '/a'\n"
      "[[ingest.folder]]\npath = '/b'\nsensor = 'gate'\ntime_from = 'mtime'\nsettle_ms = 5\n",
      "test.toml");
  REQUIRE(settings.daemon.folders.size() == 2);
  CHECK(settings.daemon.queue_limit == 7);
  CHECK(settings.daemon.folders[0].path == "/a");
  CHECK(settings.daemon.folders[0].time_from == TimeFrom::name);
  CHECK(settings.daemon.folders[1].sensor == "gate");
  CHECK(settings.daemon.folders[1].time_from == TimeFrom::mtime);
  CHECK(settings.daemon.folders[1].settle == std::chrono::milliseconds(5));
  const auto complaint = [](const char* toml) {
    try {
      parse_settings(toml, "test.toml");
    } catch (const InvalidInput& error) {
      return error.fields()[0].field + ": " + error.fields()[0].message;
    }
    return std::string("it was accepted");
  };
  CHECK(complaint("[[ingest.folder]]\nsensor = 'gate'\n") == "ingest.folder[0].path: line 1: is missing");
  CHECK(complaint("[[ingest.folder]]\npath = '/a'\nsensr = 'gate'\n") ==
        "ingest.folder[0].sensr: line 3: unknown key; did you mean ingest.folder[0].sensor?");
  CHECK(complaint("[ingest]\nfolder = '/a'\n") ==
        "ingest.folder: line 2: must be an array of tables, [[ingest.folder]], not string");
}

TEST_CASE("what would not start, or not do what it promises, is refused with its key and line") {
  const TempDir folder;
  const auto complaint = [](const std::string& toml, const SettingsGiven& given = {}) {
    try {
      parse_settings(toml, "test.toml", given);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const std::string remote = "[http]\nport = 0\nhost = '0.0.0.0'\n";
  CHECK(has(complaint(remote), "test.toml:\n  http.host, line 3: \"0.0.0.0\" is not a loopback address"));
  CHECK(has(complaint(remote), "--allow-remote, or allow_remote = true"));
  CHECK(complaint(remote + "allow_remote = true\n") == "accepted");
  CHECK(complaint(remote, {.allow_remote = true}) == "accepted");
  CHECK(complaint(remote, {.host = "127.0.0.1"}) == "accepted");
  CHECK(has(complaint("", {.host = "0.0.0.0"}), "--listen: \"0.0.0.0\" is not a loopback address"));
  CHECK(
      has(complaint("[http]\nallow_remote = true\nhost = 'not a host'\n"), "line 3: \"not a host\" must be a host's"));
  CHECK(has(complaint("[dashboard]\ndirectory = '/nope'\n"), "dashboard.directory, line 2: /nope holds no built"));
  CHECK(has(complaint("[storage]\ndata_dir = ''\n"), "storage.data_dir, line 2: must not be empty"));
  CHECK(has(complaint("[storage]\ndata_dir = '/dev/null'\n"), "line 2: is no directory"));
  CHECK(complaint("[storage]\ndata_dir = ''\n", {.data_dir = "data"}) == "accepted");
  CHECK(has(complaint("[delivery]\npublic_url = 'nourl'\n"), "delivery.public_url, line 2: must begin with https://"));
  CHECK(complaint("[delivery]\npublic_url = 'https://raywatch.example.com'\n") == "accepted");
  CHECK(has(complaint("[delivery]\nca_file = '/nope'\n"), "delivery.ca_file, line 2: there is no file /nope"));
  for (const char* proxy : {"x y", "ftp://proxy", "http://"}) {
    CAPTURE(proxy);
    CHECK(has(complaint("[delivery]\nproxy = '" + std::string(proxy) + "'\n"), "delivery.proxy, line 2: must be"));
  }
  for (const char* proxy : {"proxy:3128", "http://proxy:3128", "socks5h://user:word@[::1]:1080"}) {
    CAPTURE(proxy);
    CHECK(complaint("[delivery]\nproxy = '" + std::string(proxy) + "'\n") == "accepted");
  }
  CHECK(has(complaint("[retention]\nmin_free_mib = 10\n"), "retention.min_free_mib, line 2: must be more than"));
  CHECK(complaint("[retention]\nmin_free_mib = 300\n") == "accepted");
  const std::string path = folder.path().string();
  CHECK(has(complaint("[[ingest.folder]]\npath = '" + path + "/a'\n[[ingest.folder]]\npath = '" + path + "/b/../a/'\n"),
            "ingest.folder[1].path, line 4: is the folder of ingest.folder[0], too"));
  CHECK(has(complaint("[[ingest.folder]]\npath = ''\n"), "line 2: must not be empty"));
}

TEST_CASE("limits of what is kept reach the parts that keep it") {
  const RetentionConfig kept =
      parse_settings("[retention]\nmax_age_days = 30\nmax_mib = 2\nevents_max_age_days = 7\n", "test.toml")
          .daemon.retention;
  CHECK(limits_in_force({}, kept.defaults) == RetentionLimits{.max_age_days = 30, .max_bytes = 2u << 20});
  CHECK(kept.events_max_age == std::chrono::days(7));
}

TEST_CASE("a port that is none is refused with what is allowed") {
  try {
    parse_settings("[http]\nport = 70000\n", "test.toml");
    FAIL("it was accepted");
  } catch (const InvalidInput& error) {
    REQUIRE(error.fields().size() == 1);
    CHECK(error.fields()[0].field == "http.port");
    CHECK(error.fields()[0].message == "line 2: must be 0 to 65535, not 70000");
  }
}

}  // namespace raywatch
