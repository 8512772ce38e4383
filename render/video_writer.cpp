#include "render/video_writer.hpp"

#include <algorithm>
#include <array>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/memory_file.hpp"
#include "render/writable.hpp"

namespace touchdown {
namespace {

struct FreeFormat {
  void operator()(AVFormatContext* context) const {
    if (context->pb) avio_closep(&context->pb);
    avformat_free_context(context);
  }
};
struct FreeCodec {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
};
struct FreeFrame {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

void check(int result, const char* what) {
  if (result >= 0) return;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text = {};
  av_strerror(result, text.data(), text.size());
  throw Error(fmt::format("video: {}: {}", what, text.data()));
}

}  // namespace

struct VideoWriter::Streams {
  MemoryFile file;
  std::unique_ptr<AVFormatContext, FreeFormat> format;
  std::unique_ptr<AVCodecContext, FreeCodec> codec;
  std::unique_ptr<AVFrame, FreeFrame> frame;
  std::unique_ptr<AVPacket, FreePacket> packet;
  AVStream* stream = nullptr;
  std::int64_t frames = 0;

  /// Give the encoder a frame (or null: there are no more) and write what it has ready.
  void encode(const AVFrame* next) {
    check(avcodec_send_frame(codec.get(), next), "the encoder refuses a frame");
    while (true) {
      const int result = avcodec_receive_packet(codec.get(), packet.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      check(result, "the encoder failed");
      av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
      packet->duration = av_rescale_q(1, codec->time_base, stream->time_base);
      packet->stream_index = stream->index;
      check(av_interleaved_write_frame(format.get(), packet.get()), "cannot write");
    }
  }
};

VideoWriter::VideoWriter(std::filesystem::path path, int width, int height, int fps, int crf)
    : path_(std::move(path)), streams_(std::make_unique<Streams>()) {
  require_writable(path_);
  if (width % 2 != 0 || height % 2 != 0) {
    throw InputError(fmt::format("a video of {}x{}: expected even numbers", width, height));
  }
  av_log_set_level(AV_LOG_ERROR);
  const AVCodec* encoder = avcodec_find_encoder_by_name("libx264");
  if (!encoder) throw Error("video: FFmpeg's libraries here have no H.264 encoder (libx264)");

  AVFormatContext* format = nullptr;
  check(avformat_alloc_output_context2(&format, nullptr, "mp4", streams_->file.path().c_str()),
        "cannot make an mp4");
  streams_->format.reset(format);
  streams_->codec.reset(avcodec_alloc_context3(encoder));
  AVCodecContext& codec = *streams_->codec;
  codec.width = width;
  codec.height = height;
  codec.pix_fmt = AV_PIX_FMT_YUV420P;
  codec.time_base = {1, fps};
  codec.framerate = {fps, 1};
  codec.gop_size = 2 * fps;
  codec.thread_count = 4;  // fixed: the number changes the bytes
  codec.color_range = AVCOL_RANGE_MPEG;
  codec.color_primaries = AVCOL_PRI_SMPTE170M;
  codec.color_trc = AVCOL_TRC_SMPTE170M;
  codec.colorspace = AVCOL_SPC_SMPTE170M;
  if (format->oformat->flags & AVFMT_GLOBALHEADER) codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  format->flags |= AVFMT_FLAG_BITEXACT;
  check(av_opt_set(codec.priv_data, "preset", "veryfast", 0), "preset");
  check(av_opt_set(codec.priv_data, "crf", std::to_string(crf).c_str(), 0), "quality");
  // x264's macroblock tree reads memory that it never wrote: the same frames, other bytes.
  check(av_opt_set(codec.priv_data, "x264-params", "mbtree=0", 0), "parameters");
  check(avcodec_open2(&codec, encoder, nullptr), "cannot start the encoder");

  streams_->stream = avformat_new_stream(format, nullptr);
  if (!streams_->stream) throw Error("video: no memory for a stream");
  streams_->stream->time_base = codec.time_base;
  streams_->stream->avg_frame_rate = codec.framerate;
  check(avcodec_parameters_from_context(streams_->stream->codecpar, &codec), "parameters");
  check(avio_open(&format->pb, streams_->file.path().c_str(), AVIO_FLAG_WRITE), "cannot open");
  AVDictionary* options = nullptr;
  av_dict_set(&options, "movflags", "+faststart", 0);
  const int header = avformat_write_header(format, &options);
  av_dict_free(&options);
  check(header, "cannot begin the file");

  streams_->frame.reset(av_frame_alloc());
  streams_->packet.reset(av_packet_alloc());
  AVFrame& frame = *streams_->frame;
  frame.format = codec.pix_fmt;
  frame.width = width;
  frame.height = height;
  check(av_frame_get_buffer(&frame, 0), "no memory for a frame");
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::write(const std::uint8_t* i420) {
  AVFrame& frame = *streams_->frame;
  check(av_frame_make_writable(&frame), "no memory for a frame");
  for (int plane = 0; plane < 3; ++plane) {
    const int width = plane == 0 ? frame.width : frame.width / 2;
    const int height = plane == 0 ? frame.height : frame.height / 2;
    for (int row = 0; row < height; ++row) {
      std::copy_n(i420, width, frame.data[plane] + row * frame.linesize[plane]);
      i420 += width;
    }
  }
  frame.pts = streams_->frames++;
  streams_->encode(&frame);
}

void VideoWriter::finish() {
  streams_->encode(nullptr);
  check(av_write_trailer(streams_->format.get()), "cannot finish the file");
  check(avio_closep(&streams_->format->pb), "cannot finish the file");
  write_atomically(path_, read_file(streams_->file.path()));
  streams_.reset();
}

}  // namespace touchdown
