#pragma once

#include <string>

#include "render/encode/ffmpeg_handles.hpp"

namespace touchdown::render {

/// How frames are encoded: x264 veryfast at constant quality `crf`, 4:2:0, BT.601, a key frame
/// every 2 s. `encoder` is FFmpeg's name of an encoder that takes x264's options.
struct VideoFormat {
  int width = 0, height = 0;  ///< even
  int fps = 30;
  int crf = 21;
  std::string encoder = "libx264";
};

/// An encoder that has been started. `global_header`: the container keeps the stream's parameters.
/// The same frames give the same bytes. Errors: `InputError` for odd sizes; `Error` when FFmpeg has
/// no such encoder or it does not start.
CodecHandle start_encoder(const VideoFormat& format, bool global_header);

/// A frame for its pictures.
FrameHandle make_frame(const AVCodecContext& codec);

}  // namespace touchdown::render
