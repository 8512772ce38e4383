#include "render/film/gl_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include <GL/gl.h>
#include <fmt/format.h>

#include "core/error.hpp"
#include "render/film/shared_library.hpp"

namespace touchdown::render {

namespace {

struct Egl {
  // MuJoCo draws with the first OpenGL library that it finds among global symbols.
  SharedLibrary library{"libEGL.so.1", RTLD_GLOBAL};
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

/// Mesa's OpenGL through EGL, without a screen ("surfaceless"). It draws on the CPU unless
/// LIBGL_ALWAYS_SOFTWARE=0 selects the graphics card.
class EglContext {
 public:
  /// Makes the context current in this thread. `finish` copies into `pixels`, in the layout of
  /// `GlContext`. Errors: `Error` if the library is missing or creates no context.
  EglContext(int width, int height, std::uint8_t* pixels)
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
                      (context_ = egl().create_context(display_, config, EGL_NO_CONTEXT,
                                                       nullptr)) != EGL_NO_CONTEXT &&
                      egl().make_current(display_, surface_, surface_, context_);
    if (!made) {
      const EGLint error = egl().error();
      release();
      throw Error(fmt::format("no context (error {:#x})", error));
    }
  }
  ~EglContext() { release(); }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Waits for all drawing and copies the pixels.
  void finish() {
    egl().read_pixels(0, 0, width_, height_, GL_BGRA, GL_UNSIGNED_BYTE, pixels_);
    // OpenGL's first row is at the bottom.
    const std::ptrdiff_t row = std::ptrdiff_t{4} * width_;
    for (std::ptrdiff_t top = 0, bottom = height_ - 1; top < bottom; ++top, --bottom) {
      std::swap_ranges(pixels_ + top * row, pixels_ + (top + 1) * row, pixels_ + bottom * row);
    }
  }

 private:
  void release() {
    egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_) egl().destroy_context(display_, context_);
    if (surface_) egl().destroy_surface(display_, surface_);
  }

  int width_;
  int height_;
  std::uint8_t* pixels_;
  void* display_ = nullptr;
  void* surface_ = nullptr;
  void* context_ = nullptr;
};

// Declarations of <GL/osmesa.h>, which newer releases of Mesa no longer contain.
constexpr GLenum osmesa_bgra = 0x1;
constexpr GLint osmesa_y_up = 0x11;

struct Osmesa {
  SharedLibrary library{"libOSMesa.so.8", RTLD_GLOBAL};
  void* (*create)(GLenum format, GLint depth_bits, GLint stencil_bits, GLint accumulation_bits,
                  void* shared) = library["OSMesaCreateContextExt"];
  GLboolean (*make_current)(void* context, void* pixels, GLenum type, GLsizei width,
                            GLsizei height) = library["OSMesaMakeCurrent"];
  void (*pixel_store)(GLint name, GLint value) = library["OSMesaPixelStore"];
  void (*destroy)(void* context) = library["OSMesaDestroyContext"];
  decltype(glFinish)* finish = library["glFinish"];
};

const Osmesa& osmesa() {
  static const Osmesa loaded;
  return loaded;
}

/// Mesa's OpenGL without a window system, which draws directly into memory.
class OsmesaContext {
 public:
  /// Makes the context current in this thread; it draws into `pixels`, in the layout of
  /// `GlContext`. Errors: `Error` if the library is missing or creates no context.
  OsmesaContext(int width, int height, std::uint8_t* pixels)
      : context_(osmesa().create(osmesa_bgra, 24, 8, 0, nullptr)) {
    if (!context_ || !osmesa().make_current(context_, pixels, GL_UNSIGNED_BYTE, width, height)) {
      if (context_) osmesa().destroy(context_);
      throw Error(
          fmt::format("cannot draw {}x{} pixels off screen: Mesa makes no context", width, height));
    }
    osmesa().pixel_store(osmesa_y_up, 0);
  }
  ~OsmesaContext() {
    osmesa().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    osmesa().destroy(context_);
  }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  /// Waits until all drawing is in `pixels`.
  void finish() { osmesa().finish(); }

 private:
  void* context_;
};

/// Waits for all drawing of a context, which it owns.
template <typename Context>
std::function<void()> finisher(int width, int height, std::uint8_t* pixels) {
  return [context = std::make_shared<Context>(width, height, pixels)] { context->finish(); };
}

}  // namespace

GlContext::GlContext(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4) {
  const char* const variable = std::getenv("TOUCHDOWN_GL");
  const std::string_view asked = variable ? variable : "";
  if (!asked.empty() && asked != "osmesa" && asked != "egl") {
    throw InputError(fmt::format("TOUCHDOWN_GL={}: expected osmesa or egl", asked));
  }
  // Mesa's own threads would not survive the fork of a process that paints frames.
  ::setenv("LP_NUM_THREADS", "0", 1);
  std::string missing;
  if (asked != "egl") {
    try {
      finish_ = finisher<OsmesaContext>(width, height, pixels_.data());
      return;
    } catch (const MissingLibrary& error) {
      missing = fmt::format("OSMesa: {} (package libosmesa6)", error.what());
    }
  }
  if (asked != "osmesa") {
    try {
      finish_ = finisher<EglContext>(width, height, pixels_.data());
      return;
    } catch (const Error& error) {
      missing += fmt::format("{}EGL: {} (packages libegl1, libegl-mesa0, libgl1-mesa-dri)",
                             missing.empty() ? "" : "; ", error.what());
    }
  }
  throw Error(fmt::format("cannot draw {}x{} pixels off screen: {}", width, height, missing));
}

}  // namespace touchdown::render
