#pragma once

#include <cstddef>
#include <cstdint>

/// Reads the input as a scan file. The first byte chooses what is known about it besides: the remainder by 7 the format
/// (6: decided from the content), bit 3 world coordinates, bit 4 a given pose. Anything but success or a
/// `raywatch::Error` ends the program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
