#include "render/offscreen/gl_context.hpp"

#include <cstdlib>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/offscreen/shared_library.hpp"

namespace touchdown::render {

GlContext::GlContext(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4) {
  const char* const variable = std::getenv("TOUCHDOWN_GL");
  const std::string_view asked = variable ? variable : "";
  if (!asked.empty() && asked != "osmesa" && asked != "egl") {
    throw InputError(fmt::format("TOUCHDOWN_GL={}: expected osmesa or egl", asked));
  }
  std::string missing;
  if (asked != "egl") {
    try {
      context_.emplace<OsmesaContext>(width, height, pixels_.data());
      return;
    } catch (const MissingLibrary& error) {
      missing = fmt::format("OSMesa: {} (package libosmesa6)", error.what());
    }
  }
  if (asked != "osmesa") {
    try {
      context_.emplace<EglContext>(width, height, pixels_.data());
      return;
    } catch (const Error& error) {
      missing += fmt::format("{}EGL: {} (packages libegl1, libegl-mesa0, libgl1-mesa-dri)",
                             missing.empty() ? "" : "; ", error.what());
    }
  }
  throw Error(fmt::format("cannot draw {}x{} pixels off screen: {}", width, height, missing));
}

void GlContext::finish() {
  std::visit(
      [](auto& context) {
        if constexpr (requires { context.finish(); }) context.finish();
      },
      context_);
}

}  // namespace touchdown::render
