#include "render/encode/ffmpeg_handles.hpp"

#include <array>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::render {

void check_ffmpeg(int result, const char* what) {
  if (result >= 0) return;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text = {};
  av_strerror(result, text.data(), text.size());
  throw Error(fmt::format("video: {}: {}", what, text.data()));
}

}  // namespace touchdown::render
