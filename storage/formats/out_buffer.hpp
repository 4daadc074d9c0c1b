#pragma once

#include <charconv>
#include <cstddef>
#include <cstring>
#include <iosfwd>
#include <string_view>
#include <vector>

namespace raywatch {

/// Collects small writes into large ones. Call `flush` at the end: the destructor does not write.
class OutBuffer {
 public:
  explicit OutBuffer(std::ostream& out) : out_(out), bytes_(kCapacity) {}

  void text(std::string_view text) { raw(text.data(), text.size()); }

  void raw(const void* data, std::size_t size) {
    if (size > kCapacity - used_) {
      write_large(data, size);
      return;
    }
    std::memcpy(bytes_.data() + used_, data, size);
    used_ += size;
  }

  /// The value's bytes; the machines that this program runs on are little endian, as the formats that it writes.
  template <class T>
  void bits(T value) {
    raw(&value, sizeof(value));
  }

  /// The shortest text that reads back as the same number.
  template <class Number>
  void number(Number value) {
    constexpr std::size_t kLongest = 32;
    if (kCapacity - used_ < kLongest) flush();
    char* const begin = bytes_.data() + used_;
    used_ += static_cast<std::size_t>(std::to_chars(begin, begin + kLongest, value).ptr - begin);
  }

  void character(char c) { raw(&c, 1); }

  /// @throws StorageError when the stream fails.
  void flush();

 private:
  static constexpr std::size_t kCapacity = std::size_t{1} << 18;

  void write_large(const void* data, std::size_t size);

  std::ostream& out_;
  std::vector<char> bytes_;
  std::size_t used_ = 0;
};

}  // namespace raywatch
