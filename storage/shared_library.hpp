#pragma once

#include <string>

namespace raywatch {

/// A library that is loaded when it is first needed, so that what does not need it starts without it.
class SharedLibrary {
 public:
  struct Name {
    const char* soname;   ///< "libproj.so.25"
    const char* package;  ///< the Debian package that has it, for the message
  };
  /// @throws StorageError when it cannot be loaded, naming the package.
  explicit SharedLibrary(const Name& name);

  /// A function of it, of the type that its header declares. @throws StorageError when it has none of that name.
  template <class Function>
  void find(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(address(name));
  }

 private:
  void* address(const char* name) const;

  std::string soname_;
  void* handle_;  ///< never closed: such libraries keep threads and buffers of their own
};

}  // namespace raywatch
