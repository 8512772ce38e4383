#pragma once

#include <dlfcn.h>

#include "core/error.hpp"

namespace touchdown::render {

class MissingLibrary : public Error {
 public:
  using Error::Error;
};

/// A system library that is loaded on demand until the process ends, so that only commands that
/// need it pay for it.
class SharedLibrary {
 public:
  /// The address of a function; converts to any function pointer.
  struct Symbol {
    void* address;
    template <typename Function>
    operator Function*() const {
      return reinterpret_cast<Function*>(address);
    }
  };

  /// `scope` is RTLD_GLOBAL if libraries that are loaded later may use its symbols, or RTLD_LOCAL.
  /// Errors: `MissingLibrary` with the linker's reason.
  SharedLibrary(const char* name, int scope) : handle_(::dlopen(name, RTLD_NOW | scope)) {
    if (!handle_) throw MissingLibrary(::dlerror());
  }

  /// Errors: `Error` if neither the library nor those that it loads have a symbol of that name.
  Symbol operator[](const char* name) const {
    void* const address = ::dlsym(handle_, name);
    if (!address) throw Error(::dlerror());
    return {address};
  }

 private:
  void* handle_;
};

}  // namespace touchdown::render
