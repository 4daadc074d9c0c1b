#!/usr/bin/env python3
"""Checks that includes point one way: core <- storage <- api <- server, with config beside storage.

Also that core stays pure (no I/O, clock, thread, log, JSON or SQL), that what a layer hides is used by it alone, and that
each source includes its own header first, so that the header compiles alone.
Prints every violation as FILE:LINE: REASON and ends with 1 if there is any.
"""
import pathlib
import re
import sys

# What each folder may include of the others.
MAY_INCLUDE = {
    "core": {"core"},
    "storage": {"core", "storage"},
    "config": {"core", "config"},
    "api": {"core", "storage", "api"},
    "server": {"core", "storage", "config", "api", "server"},
}

# System headers (as whole names, or as folders that end in a slash), and the only folders that may use them.
ONLY_IN = [
    (("sqlite3.h", "zstd.h", "pcl/", "gdal.h", "proj.h", "png.h", "minizip/"), {"storage"}),
    (("toml++/",), {"config"}),
    (("CLI/",), {"server"}),
    (("httplib.h", "spdlog/"), {"api", "server"}),
    (("nlohmann/",), {"storage", "api", "server"}),
    (("fstream", "iostream", "filesystem", "thread", "condition_variable", "future", "csignal", "unistd.h",
      "fcntl.h", "sys/"), {"storage", "config", "api", "server"}),
]

# What an index asks of the system's memory (huge pages) is no input and no output.
ALSO_IN_CORE = {"sys/mman.h"}

# A clock in core would make results depend on more than their arguments.
CLOCK = re.compile(r"\b(system_clock|steady_clock|high_resolution_clock)::now\b|\bclock_gettime\b|\bgettimeofday\b")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def violations_of_line(folder, line):
    found = INCLUDE.match(line)
    if found and found.group(1) == '"':
        target = found.group(2).split("/")[0]
        if target not in MAY_INCLUDE:
            yield f'"{found.group(2)}" is not given from the root of the project'
        elif target not in MAY_INCLUDE[folder]:
            yield f"{folder}/ must not include {target}/"
    elif found:
        header = found.group(2)
        for names, folders in ONLY_IN:
            named = any(header.startswith(name) if name.endswith("/") else header == name for name in names)
            if folder == "core" and header in ALSO_IN_CORE:
                continue
            if named and folder not in folders:
                yield f"{folder}/ must not include <{header}>"
    if folder == "core" and CLOCK.search(line):
        yield "core/ must not read a clock"


def first_include(lines):
    return next((found.group(2) for line in lines if (found := INCLUDE.match(line))), None)


def includes_own_header_first(file, root, lines):
    header = file.with_suffix(".hpp")
    return not header.exists() or first_include(lines) == str(header.relative_to(root))


def violations(root):
    for folder in MAY_INCLUDE:
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in (".hpp", ".cpp"):
                continue
            lines = file.read_text(encoding="utf-8").splitlines()
            if file.suffix == ".cpp" and not includes_own_header_first(file, root, lines):
                yield f"{file.relative_to(root)}:1: its own header must be its first include"
            for number, line in enumerate(lines, start=1):
                for reason in violations_of_line(folder, line):
                    yield f"{file.relative_to(root)}:{number}: {reason}"


def self_test():
    """The rules find what they are for."""
    wrong = [("core", '#include "storage/store.hpp"'), ("api", '#include "server/daemon.hpp"'),
             ("storage", '#include "config/config_reader.hpp"'), ("core", "#include <fstream>"),
             ("core", "#include <nlohmann/json.hpp>"), ("core", "#include <spdlog/spdlog.h>"),
             ("api", "#include <sqlite3.h>"), ("core", "  auto now = std::chrono::steady_clock::now();"),
             ("server", "#include <pcl/point_cloud.h>"), ("core", '#include "pose.hpp"'),
             ("core", "#include <sys/stat.h>")]
    right = [("server", '#include "core/pose.hpp"'), ("core", "#include <chrono>"), ("core", "#include <vector>"),
             ("api", '#include "storage/store.hpp"'), ("storage", "#include <sqlite3.h>"),
             ("core", "#include <sys/mman.h>")]
    assert first_include(["// a comment", '#include "core/pose.hpp"', "#include <vector>"]) == "core/pose.hpp"
    for folder, line in wrong:
        assert list(violations_of_line(folder, line)), f"not found: {folder}: {line}"
    for folder, line in right:
        assert not list(violations_of_line(folder, line)), f"wrongly found: {folder}: {line}"


def main():
    self_test()
    found = list(violations(pathlib.Path(sys.argv[1])))
    print("\n".join(found) if found else "All includes point the right way.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
