#pragma once

#include <cstdint>

namespace touchdown::render {

/// Mesa's OpenGL behind EGL, on no surface of any screen ("surfaceless"), by the processor alone
/// unless LIBGL_ALWAYS_SOFTWARE=0 asks for the graphics card.
class EglContext {
 public:
  /// Current in this thread; `finish` copies into `pixels` as `GlContext` describes them. Errors:
  /// `Error` if the library is not there or makes no context.
  EglContext(int width, int height, std::uint8_t* pixels);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Waits for all drawing and copies it.
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
