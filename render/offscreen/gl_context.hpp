#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "render/offscreen/egl_context.hpp"
#include "render/offscreen/osmesa_context.hpp"

namespace touchdown::render {

/// An OpenGL context that draws into plain memory, without a display or a GPU, and is current in
/// the thread that made it for as long as it lives. It is OSMesa's where there is OSMesa, and EGL's
/// elsewhere; the environment variable TOUCHDOWN_GL, `osmesa` or `egl`, asks for one of them. A
/// process keeps to the one it began with, for so does MuJoCo.
///
/// All contexts of one process share one rasteriser: for more speed use more processes
/// (`paint_in_order`). Never fork a process that has one. Errors: `Error` when there is none, with
/// both reasons and the packages; `InputError` for another value of TOUCHDOWN_GL.
class GlContext {
 public:
  GlContext(int width, int height);

  /// Waits until all drawing is in `pixels`.
  void finish();

  /// BGRA, 8 bits each, rows from the top, no padding.
  std::uint8_t* pixels() { return pixels_.data(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> pixels_;
  std::variant<std::monostate, OsmesaContext, EglContext> context_;
};

}  // namespace touchdown::render
