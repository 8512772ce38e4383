#pragma once

#include "core/error.hpp"

namespace touchdown::render {

/// The error for a library that is not installed on this machine.
class MissingLibrary : public Error {
 public:
  using Error::Error;
};

/// A system library, loaded on demand until the process ends. Its symbols are global: MuJoCo draws
/// with the first OpenGL library that it finds among them.
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

  /// Errors: `MissingLibrary` with the linker's reason.
  explicit SharedLibrary(const char* name);

  /// Errors: `Error` if the library has no symbol of that name.
  Symbol operator[](const char* name) const;

 private:
  void* handle_;
};

}  // namespace touchdown::render
