#include "render/encode/encoder.hpp"

extern "C" {
#include <libavutil/opt.h>
}

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::render {

CodecHandle start_encoder(const VideoFormat& format, bool global_header) {
  if (format.width % 2 != 0 || format.height % 2 != 0) {
    throw InputError(
        fmt::format("a video of {}x{}: expected even numbers", format.width, format.height));
  }
  av_log_set_level(AV_LOG_ERROR);
  const AVCodec* encoder = avcodec_find_encoder_by_name(format.encoder.c_str());
  if (!encoder) {
    throw Error(
        fmt::format("video: FFmpeg's libraries here have no H.264 encoder ({})", format.encoder));
  }
  CodecHandle handle(avcodec_alloc_context3(encoder));
  if (!handle) throw Error("video: no memory for an encoder");
  AVCodecContext& codec = *handle;
  codec.width = format.width;
  codec.height = format.height;
  codec.pix_fmt = AV_PIX_FMT_YUV420P;
  codec.time_base = {1, format.fps};
  codec.framerate = {format.fps, 1};
  codec.gop_size = 2 * format.fps;
  codec.thread_count = 4;  // fixed: the number changes the bytes
  codec.color_range = AVCOL_RANGE_MPEG;
  codec.color_primaries = AVCOL_PRI_SMPTE170M;
  codec.color_trc = AVCOL_TRC_SMPTE170M;
  codec.colorspace = AVCOL_SPC_SMPTE170M;
  if (global_header) codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  check_ffmpeg(av_opt_set(codec.priv_data, "preset", "veryfast", 0), "preset");
  check_ffmpeg(av_opt_set(codec.priv_data, "crf", std::to_string(format.crf).c_str(), 0),
               "quality");
  // x264's macroblock tree reads memory that it never wrote: the same frames, other bytes.
  check_ffmpeg(av_opt_set(codec.priv_data, "x264-params", "mbtree=0", 0), "parameters");
  check_ffmpeg(avcodec_open2(&codec, encoder, nullptr), "cannot start the encoder");
  return handle;
}

FrameHandle make_frame(const AVCodecContext& codec) {
  FrameHandle frame(av_frame_alloc());
  if (!frame) throw Error("video: no memory for a frame");
  frame->format = codec.pix_fmt;
  frame->width = codec.width;
  frame->height = codec.height;
  check_ffmpeg(av_frame_get_buffer(frame.get(), 0), "no memory for a frame");
  return frame;
}

}  // namespace touchdown::render
