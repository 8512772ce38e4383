#pragma once

#include <cstdint>

namespace touchdown::render {

/// Mesa's OpenGL without a window system: draws straight into memory.
class OsmesaContext {
 public:
  /// Current in this thread; draws into `pixels` as `GlContext` describes them. Errors: `Error` if
  /// the library is not there or makes no context.
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
