#pragma once

#include <cstdint>

namespace touchdown::render {

/// Mesa's OpenGL through EGL, without a screen ("surfaceless"). It draws on the CPU unless
/// LIBGL_ALWAYS_SOFTWARE=0 selects the graphics card.
class EglContext {
 public:
  /// Makes the context current in this thread. `finish` copies into `pixels`, in the layout of
  /// `GlContext`. Errors: `Error` if the library is missing or creates no context.
  EglContext(int width, int height, std::uint8_t* pixels);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Waits for all drawing and copies the pixels.
  void finish();

 private:
  void release();

  int width_;
  int height_;
  std::uint8_t* pixels_;
  void* display_ = nullptr;
  void* surface_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace touchdown::render
