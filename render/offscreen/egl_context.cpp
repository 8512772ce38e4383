#include "render/offscreen/egl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <cstdlib>

#include <GL/gl.h>
#include <fmt/format.h>

#include "core/error.hpp"
#include "render/offscreen/shared_library.hpp"

namespace touchdown::render {
namespace {

struct Egl {
  SharedLibrary library{"libEGL.so.1"};
  decltype(eglGetPlatformDisplay)* get_platform_display = library["eglGetPlatformDisplay"];
  decltype(eglInitialize)* initialize = library["eglInitialize"];
  decltype(eglBindAPI)* bind_api = library["eglBindAPI"];
  decltype(eglChooseConfig)* choose_config = library["eglChooseConfig"];
  decltype(eglCreatePbufferSurface)* create_surface = library["eglCreatePbufferSurface"];
  decltype(eglCreateContext)* create_context = library["eglCreateContext"];
  decltype(eglMakeCurrent)* make_current = library["eglMakeCurrent"];
  decltype(eglDestroySurface)* destroy_surface = library["eglDestroySurface"];
  decltype(eglDestroyContext)* destroy_context = library["eglDestroyContext"];
  decltype(eglGetError)* error = library["eglGetError"];
  decltype(eglGetProcAddress)* address = library["eglGetProcAddress"];
  decltype(glReadPixels)* read_pixels =
      reinterpret_cast<decltype(glReadPixels)*>(address("glReadPixels"));
};

const Egl& egl() {
  static const Egl loaded;
  return loaded;
}

/// Opens the display, which belongs to the process until it ends.
EGLDisplay open_display() {
  // Pixels must not depend on the machine's graphics card.
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
  const EGLDisplay display =
      egl().get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !egl().initialize(display, nullptr, nullptr)) {
    throw Error(fmt::format("no display without a screen (error {:#x})", egl().error()));
  }
  return display;
}

}  // namespace

EglContext::EglContext(int width, int height, std::uint8_t* pixels)
    : width_(width), height_(height), pixels_(pixels), display_(open_display()) {
  constexpr EGLint wanted[][2] = {{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT},
                                  {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT},
                                  {EGL_RED_SIZE, 8},
                                  {EGL_GREEN_SIZE, 8},
                                  {EGL_BLUE_SIZE, 8},
                                  {EGL_ALPHA_SIZE, 8},
                                  {EGL_DEPTH_SIZE, 24},
                                  {EGL_STENCIL_SIZE, 8},
                                  {EGL_NONE, EGL_NONE}};
  const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  const bool made = egl().bind_api(EGL_OPENGL_API) &&
                    egl().choose_config(display_, *wanted, &config, 1, &count) && count == 1 &&
                    (surface_ = egl().create_surface(display_, config, size)) != EGL_NO_SURFACE &&
                    (context_ = egl().create_context(display_, config, EGL_NO_CONTEXT, nullptr)) !=
                        EGL_NO_CONTEXT &&
                    egl().make_current(display_, surface_, surface_, context_);
  if (!made) {
    const EGLint error = egl().error();
    release();
    throw Error(fmt::format("no context (error {:#x})", error));
  }
}

EglContext::~EglContext() { release(); }

void EglContext::release() {
  egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_) egl().destroy_context(display_, context_);
  if (surface_) egl().destroy_surface(display_, surface_);
}

void EglContext::finish() {
  egl().read_pixels(0, 0, width_, height_, GL_BGRA, GL_UNSIGNED_BYTE, pixels_);
  // OpenGL's first row is at the bottom.
  const std::ptrdiff_t row = std::ptrdiff_t{4} * width_;
  for (std::ptrdiff_t top = 0, bottom = height_ - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(pixels_ + top * row, pixels_ + (top + 1) * row, pixels_ + bottom * row);
  }
}

}  // namespace touchdown::render
