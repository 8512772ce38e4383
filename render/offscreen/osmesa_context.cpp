#include "render/offscreen/osmesa_context.hpp"

#include <GL/gl.h>
#include <fmt/format.h>

#include "core/error.hpp"
#include "render/offscreen/shared_library.hpp"

namespace touchdown::render {
namespace {

// Declarations of <GL/osmesa.h>, which newer releases of Mesa no longer contain.
constexpr GLenum osmesa_bgra = 0x1;
constexpr GLint osmesa_y_up = 0x11;

struct Osmesa {
  SharedLibrary library{"libOSMesa.so.8"};
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

}  // namespace

OsmesaContext::OsmesaContext(int width, int height, std::uint8_t* pixels)
    : context_(osmesa().create(osmesa_bgra, 24, 8, 0, nullptr)) {
  if (!context_ || !osmesa().make_current(context_, pixels, GL_UNSIGNED_BYTE, width, height)) {
    if (context_) osmesa().destroy(context_);
    throw Error(
        fmt::format("cannot draw {}x{} pixels off screen: Mesa makes no context", width, height));
  }
  osmesa().pixel_store(osmesa_y_up, 0);
}

OsmesaContext::~OsmesaContext() {
  osmesa().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  osmesa().destroy(context_);
}

void OsmesaContext::finish() { osmesa().finish(); }

}  // namespace touchdown::render
