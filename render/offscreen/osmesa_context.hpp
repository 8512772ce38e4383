#pragma once

#include <cstdint>

namespace touchdown::render {

/// Mesa's OpenGL without a window system, which draws directly into memory.
class OsmesaContext {
 public:
  /// Makes the context current in this thread; it draws into `pixels`, in the layout of
  /// `GlContext`. Errors: `Error` if the library is missing or creates no context.
  OsmesaContext(int width, int height, std::uint8_t* pixels);
  ~OsmesaContext();
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  /// Waits until all drawing is in `pixels`.
  void finish();

 private:
  void* context_;
};

}  // namespace touchdown::render
