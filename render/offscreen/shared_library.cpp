#include "render/offscreen/shared_library.hpp"

#include <dlfcn.h>

namespace touchdown::render {

SharedLibrary::SharedLibrary(const char* name) : handle_(::dlopen(name, RTLD_NOW | RTLD_GLOBAL)) {
  if (!handle_) throw MissingLibrary(::dlerror());
}

SharedLibrary::Symbol SharedLibrary::operator[](const char* name) const {
  void* const address = ::dlsym(handle_, name);
  if (!address) throw Error(::dlerror());
  return {address};
}

}  // namespace touchdown::render
