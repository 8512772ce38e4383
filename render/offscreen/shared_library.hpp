#pragma once

#include "core/error.hpp"

namespace touchdown::render {

/// A library that is not on this machine.
class MissingLibrary : public Error {
 public:
  using Error::Error;
};

/// A library of the system that is loaded when it is needed and stays until the process ends. All
/// see its symbols: MuJoCo draws with the OpenGL of whichever library it finds among them.
class SharedLibrary {
 public:
  /// Becomes a pointer to the function that it is.
  struct Symbol {
    void* address;
    template <typename Function>
    operator Function*() const {
      return reinterpret_cast<Function*>(address);
    }
  };

  /// Errors: `MissingLibrary` with the linker's reason.
  explicit SharedLibrary(const char* name);

  /// Errors: `Error` if the library has nothing of that name.
  Symbol operator[](const char* name) const;

 private:
  void* handle_;
};

}  // namespace touchdown::render
