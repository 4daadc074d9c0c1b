#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#include <sys/mman.h>

namespace raywatch {

/// An array that is not initialised and not resized, for planes of millions of values: large ones ask for huge pages,
/// which halves the cost of touching them first. Vectors may be loaded, not stored, up to `kPadding` bytes past the
/// end.
template <class T>
class RawArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  static constexpr std::size_t kPadding = 64;

  RawArray() = default;
  explicit RawArray(std::size_t size) : size_(size) {
    constexpr std::size_t kHugePage = std::size_t{1} << 21;
    const std::size_t wanted = size * sizeof(T) + kPadding;
    const bool huge = wanted >= 2 * kHugePage;
    const std::size_t alignment = huge ? kHugePage : std::size_t{64};
    const std::size_t bytes = (wanted + alignment - 1) / alignment * alignment;
    data_.reset(static_cast<T*>(std::aligned_alloc(alignment, bytes)));
    if (!data_) throw std::bad_alloc();
    if (huge) ::madvise(data_.get(), bytes, MADV_HUGEPAGE);  // advice: without it everything works, only slower
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

 private:
  struct Free {
    void operator()(T* memory) const { std::free(memory); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace raywatch
