#include "api/scratch_dir.hpp"

#include <stdlib.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/error.hpp"

namespace raywatch {

ScratchDir::ScratchDir(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  std::string name = (directory / "answer-XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    throw StorageError("cannot make a directory in " + directory.string() + ": " +
                       std::generic_category().message(errno));
  }
  path_ = name;
}

ScratchDir::~ScratchDir() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  if (!in || !content) throw StorageError("cannot read " + path.string());
  return std::move(content).str();
}

}  // namespace raywatch
