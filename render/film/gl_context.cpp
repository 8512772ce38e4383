#include "render/film/gl_context.hpp"

#include <GL/osmesa.h>
#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::render {

GlContext::GlContext(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4) {
  const OSMesaContext context = OSMesaCreateContextExt(OSMESA_BGRA, 24, 8, 0, nullptr);
  context_ = context;
  if (!context || !OSMesaMakeCurrent(context, pixels_.data(), GL_UNSIGNED_BYTE, width, height)) {
    if (context) OSMesaDestroyContext(context);
    throw Error(
        fmt::format("cannot draw {}x{} pixels off screen: Mesa makes no context", width, height));
  }
  OSMesaPixelStore(OSMESA_Y_UP, 0);
}

GlContext::~GlContext() {
  OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  OSMesaDestroyContext(static_cast<OSMesaContext>(context_));
}

void GlContext::finish() { glFinish(); }

}  // namespace touchdown::render
