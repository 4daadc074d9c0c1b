#include "storage/formats/out_buffer.hpp"

#include <bit>
#include <ostream>

#include "core/error.hpp"

namespace raywatch {

static_assert(std::endian::native == std::endian::little, "the writers copy numbers as they stand in memory");

void OutBuffer::write_large(const void* data, std::size_t size) {
  flush();
  out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  if (!out_) throw StorageError("the points cannot be written: the output stream failed");
}

void OutBuffer::flush() {
  out_.write(bytes_.data(), static_cast<std::streamsize>(used_));
  used_ = 0;
  if (!out_) throw StorageError("the points cannot be written: the output stream failed");
}

}  // namespace raywatch
