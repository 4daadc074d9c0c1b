#include "storage/shared_library.hpp"

#include <dlfcn.h>

#include "core/error.hpp"

namespace raywatch {

SharedLibrary::SharedLibrary(const Name& name)
    : soname_(name.soname), handle_(dlopen(name.soname, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) {
    throw StorageError("Cannot load " + soname_ + "; install the package " + name.package + ". (" + dlerror() + ")");
  }
}

void* SharedLibrary::address(const char* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) throw StorageError(soname_ + " has no function " + name + ": another version is installed.");
  return found;
}

}  // namespace raywatch
