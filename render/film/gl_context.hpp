#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace touchdown::render {

/// An OpenGL context that draws into plain memory, without a display or a GPU. It is current in the
/// thread that created it, for its whole lifetime. It uses OSMesa where this is installed, and EGL
/// elsewhere; the environment variable TOUCHDOWN_GL, `osmesa` or `egl`, selects one of them. A
/// process must not change its choice, because MuJoCo does not.
///
/// All contexts of a process share one rasteriser: for more speed use more processes
/// (`paint_in_order`). Never fork a process that has a context. Errors: `Error` when neither
/// library works, with both reasons and the packages; `InputError` for another value of
/// TOUCHDOWN_GL.
class GlContext {
 public:
  GlContext(int width, int height);
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Waits until `pixels` contains all drawing.
  void finish() { finish_(); }

  /// BGRA, 8 bits each, rows from the top, no padding.
  std::uint8_t* pixels() { return pixels_.data(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> pixels_;
  std::function<void()> finish_;  ///< owns the library's context
};

}  // namespace touchdown::render
