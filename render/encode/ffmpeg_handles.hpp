#pragma once

#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace touchdown::render {

/// FFmpeg's objects, freed as FFmpeg wants it.
struct FfmpegFree {
  void operator()(AVFormatContext* context) const {
    if (context->pb) avio_closep(&context->pb);
    avformat_free_context(context);
  }
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
using FormatHandle = std::unique_ptr<AVFormatContext, FfmpegFree>;
using CodecHandle = std::unique_ptr<AVCodecContext, FfmpegFree>;
using FrameHandle = std::unique_ptr<AVFrame, FfmpegFree>;
using PacketHandle = std::unique_ptr<AVPacket, FfmpegFree>;

/// Throws `Error` with FFmpeg's reason when `result` is negative; `what` failed.
void check_ffmpeg(int result, const char* what);

}  // namespace touchdown::render
