#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"

namespace raywatch {

/// Runs `read`; what it throws about the content of a file gets the file's name before it.
template <class Read>
auto naming(const std::filesystem::path& file, Read&& read) {
  const auto named = [&](const Error& error) { return file.string() + ": " + error.what(); };
  try {
    return read();
  } catch (const InvalidInput& error) {
    throw InvalidInput(named(error), error.fields());
  } catch (const UnsupportedFormat& error) {
    throw UnsupportedFormat(named(error));
  } catch (const TooLarge& error) {
    throw TooLarge(named(error));
  }
}

}  // namespace raywatch
