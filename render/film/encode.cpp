#include "render/film/encode.hpp"

#include <algorithm>
#include <array>
#include <png.h>
#include <sys/mman.h>
#include <turbojpeg.h>
#include <unistd.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/macros.h>
#include <libavutil/opt.h>
}

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/film/shared_library.hpp"

namespace touchdown::render {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* reason) {
  throw Error(fmt::format("{}: cannot compress the picture: {}", path.string(), reason));
}

// OpenCV's own `imencode` uses the same two libraries. Its library loads a hundred others, which
// more than doubles the start of every command.
std::string png(const cv::Mat& bgr, const std::filesystem::path& path) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(bgr.cols);
  image.height = static_cast<png_uint_32>(bgr.rows);
  image.format = PNG_FORMAT_BGR;
  const auto row = static_cast<png_int_32>(bgr.step[0]);
  std::string file(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = file.size();
  if (!png_image_write_to_memory(&image, file.data(), &size, 0, bgr.data, row, nullptr)) {
    fail(path, image.message);
  }
  file.resize(size);
  return file;
}

std::string jpeg(const cv::Mat& bgr, const std::filesystem::path& path) {
  constexpr int quality = 82;
  const std::unique_ptr<void, decltype(&tjDestroy)> compressor(tjInitCompress(), &tjDestroy);
  if (!compressor) fail(path, tjGetErrorStr2(nullptr));
  unsigned char* bytes = nullptr;
  unsigned long size = 0;  // NOLINT(google-runtime-int): the library's type
  const int status =
      tjCompress2(compressor.get(), bgr.data, bgr.cols, static_cast<int>(bgr.step[0]), bgr.rows,
                  TJPF_BGR, &bytes, &size, TJSAMP_420, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> buffer(bytes, &tjFree);
  if (status != 0) fail(path, tjGetErrorStr2(compressor.get()));
  return {reinterpret_cast<const char*>(bytes), size};
}

/// An unnamed file in memory, which the system removes when the process ends.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("touchdown-video", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error("no memory for a video");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

/// FFmpeg's functions. Its libraries load a hundred others, so that films alone load them. The
/// first one loads the two others.
struct Ffmpeg {
  SharedLibrary library{"libavformat.so." AV_STRINGIFY(LIBAVFORMAT_VERSION_MAJOR), RTLD_LOCAL};
  decltype(::av_dict_free)* av_dict_free = library["av_dict_free"];
  decltype(::av_dict_set)* av_dict_set = library["av_dict_set"];
  decltype(::av_frame_alloc)* av_frame_alloc = library["av_frame_alloc"];
  decltype(::av_frame_free)* av_frame_free = library["av_frame_free"];
  decltype(::av_frame_get_buffer)* av_frame_get_buffer = library["av_frame_get_buffer"];
  decltype(::av_frame_make_writable)* av_frame_make_writable = library["av_frame_make_writable"];
  decltype(::av_interleaved_write_frame)* av_interleaved_write_frame =
      library["av_interleaved_write_frame"];
  decltype(::av_log_set_level)* av_log_set_level = library["av_log_set_level"];
  decltype(::av_opt_set)* av_opt_set = library["av_opt_set"];
  decltype(::av_packet_alloc)* av_packet_alloc = library["av_packet_alloc"];
  decltype(::av_packet_free)* av_packet_free = library["av_packet_free"];
  decltype(::av_packet_rescale_ts)* av_packet_rescale_ts = library["av_packet_rescale_ts"];
  decltype(::av_rescale_q)* av_rescale_q = library["av_rescale_q"];
  decltype(::av_strerror)* av_strerror = library["av_strerror"];
  decltype(::av_write_trailer)* av_write_trailer = library["av_write_trailer"];
  decltype(::avcodec_alloc_context3)* avcodec_alloc_context3 = library["avcodec_alloc_context3"];
  decltype(::avcodec_find_encoder_by_name)* avcodec_find_encoder_by_name =
      library["avcodec_find_encoder_by_name"];
  decltype(::avcodec_free_context)* avcodec_free_context = library["avcodec_free_context"];
  decltype(::avcodec_open2)* avcodec_open2 = library["avcodec_open2"];
  decltype(::avcodec_parameters_from_context)* avcodec_parameters_from_context =
      library["avcodec_parameters_from_context"];
  decltype(::avcodec_receive_packet)* avcodec_receive_packet = library["avcodec_receive_packet"];
  decltype(::avcodec_send_frame)* avcodec_send_frame = library["avcodec_send_frame"];
  decltype(::avformat_alloc_output_context2)* avformat_alloc_output_context2 =
      library["avformat_alloc_output_context2"];
  decltype(::avformat_free_context)* avformat_free_context = library["avformat_free_context"];
  decltype(::avformat_new_stream)* avformat_new_stream = library["avformat_new_stream"];
  decltype(::avformat_write_header)* avformat_write_header = library["avformat_write_header"];
  decltype(::avio_closep)* avio_closep = library["avio_closep"];
  decltype(::avio_open)* avio_open = library["avio_open"];
};

/// Errors: `Error` if FFmpeg is not installed.
const Ffmpeg& ffmpeg() {
  static const Ffmpeg loaded = [] {
    try {
      return Ffmpeg();
    } catch (const MissingLibrary& error) {
      throw Error(fmt::format("video: FFmpeg is missing: {} (package libavformat{})", error.what(),
                              LIBAVFORMAT_VERSION_MAJOR));
    }
  }();
  return loaded;
}

struct FfmpegFree {
  void operator()(AVFormatContext* context) const {
    if (context->pb) ffmpeg().avio_closep(&context->pb);
    ffmpeg().avformat_free_context(context);
  }
  void operator()(AVCodecContext* context) const { ffmpeg().avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { ffmpeg().av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { ffmpeg().av_packet_free(&packet); }
};
using FormatHandle = std::unique_ptr<AVFormatContext, FfmpegFree>;
using CodecHandle = std::unique_ptr<AVCodecContext, FfmpegFree>;
using FrameHandle = std::unique_ptr<AVFrame, FfmpegFree>;
using PacketHandle = std::unique_ptr<AVPacket, FfmpegFree>;

std::string ffmpeg_reason(int result) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text = {};
  ffmpeg().av_strerror(result, text.data(), text.size());
  return text.data();
}

/// Throws that `what` failed, with FFmpeg's reason, when `result` is negative.
void check_ffmpeg(int result, const char* what) {
  if (result < 0) throw Error(fmt::format("video: {}: {}", what, ffmpeg_reason(result)));
}

/// Throws that the file cannot be written when `result` is negative.
void check_written(int result, const std::filesystem::path& path) {
  if (result >= 0) return;
  throw Error(fmt::format("{}: cannot be written: {}", path.string(), ffmpeg_reason(result)));
}

/// A started encoder. With `global_header`, the container stores the stream's parameters.
CodecHandle start_encoder(const VideoFormat& format, bool global_header) {
  if (format.width % 2 != 0 || format.height % 2 != 0) {
    throw InputError(
        fmt::format("a video of {}x{}: expected even numbers", format.width, format.height));
  }
  ffmpeg().av_log_set_level(AV_LOG_ERROR);
  const AVCodec* encoder = ffmpeg().avcodec_find_encoder_by_name(format.encoder.c_str());
  if (!encoder) {
    throw Error(
        fmt::format("video: FFmpeg's libraries here have no H.264 encoder ({})", format.encoder));
  }
  CodecHandle handle(ffmpeg().avcodec_alloc_context3(encoder));
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
  check_ffmpeg(ffmpeg().av_opt_set(codec.priv_data, "preset", "veryfast", 0), "preset");
  check_ffmpeg(ffmpeg().av_opt_set(codec.priv_data, "crf", std::to_string(format.crf).c_str(), 0),
               "quality");
  // x264's macroblock tree reads uninitialised memory, which makes the bytes differ between runs.
  check_ffmpeg(ffmpeg().av_opt_set(codec.priv_data, "x264-params", "mbtree=0", 0), "parameters");
  check_ffmpeg(ffmpeg().avcodec_open2(&codec, encoder, nullptr), "cannot start the encoder");
  return handle;
}

FrameHandle make_frame(const AVCodecContext& codec) {
  FrameHandle frame(ffmpeg().av_frame_alloc());
  if (!frame) throw Error("video: no memory for a frame");
  frame->format = codec.pix_fmt;
  frame->width = codec.width;
  frame->height = codec.height;
  check_ffmpeg(ffmpeg().av_frame_get_buffer(frame.get(), 0), "no memory for a frame");
  return frame;
}

}  // namespace

void write_picture(const cv::Mat& bgr, const std::filesystem::path& path) {
  write_atomically(path, path.extension() == ".jpg" ? jpeg(bgr, path) : png(bgr, path));
}

struct VideoWriter::Streams {
  MemoryFile file;
  FormatHandle format;
  CodecHandle codec;
  FrameHandle frame;
  PacketHandle packet;
  AVStream* stream = nullptr;
  std::int64_t frames = 0;

  /// Passes a frame to the encoder (null after the last one), and writes its finished packets.
  void encode(const AVFrame* next) {
    check_ffmpeg(ffmpeg().avcodec_send_frame(codec.get(), next), "the encoder refuses a frame");
    while (true) {
      const int result = ffmpeg().avcodec_receive_packet(codec.get(), packet.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      check_ffmpeg(result, "the encoder failed");
      ffmpeg().av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
      packet->duration = ffmpeg().av_rescale_q(1, codec->time_base, stream->time_base);
      packet->stream_index = stream->index;
      check_ffmpeg(ffmpeg().av_interleaved_write_frame(format.get(), packet.get()), "cannot write");
    }
  }
};

VideoWriter::VideoWriter(std::filesystem::path path, const VideoFormat& video)
    : path_(std::move(path)), streams_(std::make_unique<Streams>()) {
  require_writable(path_);
  AVFormatContext* format = nullptr;
  check_ffmpeg(ffmpeg().avformat_alloc_output_context2(&format, nullptr, "mp4",
                                                       streams_->file.path().c_str()),
               "cannot make an mp4");
  streams_->format.reset(format);
  format->flags |= AVFMT_FLAG_BITEXACT;
  streams_->codec = start_encoder(video, (format->oformat->flags & AVFMT_GLOBALHEADER) != 0);
  const AVCodecContext& codec = *streams_->codec;

  streams_->stream = ffmpeg().avformat_new_stream(format, nullptr);
  if (!streams_->stream) throw Error("video: no memory for a stream");
  streams_->stream->time_base = codec.time_base;
  streams_->stream->avg_frame_rate = codec.framerate;
  check_ffmpeg(ffmpeg().avcodec_parameters_from_context(streams_->stream->codecpar, &codec),
               "parameters");
  check_ffmpeg(ffmpeg().avio_open(&format->pb, streams_->file.path().c_str(), AVIO_FLAG_WRITE),
               "cannot open");
  AVDictionary* options = nullptr;
  ffmpeg().av_dict_set(&options, "movflags", "+faststart", 0);
  const int header = ffmpeg().avformat_write_header(format, &options);
  ffmpeg().av_dict_free(&options);
  check_ffmpeg(header, "cannot begin the file");
  streams_->frame = make_frame(codec);
  streams_->packet.reset(ffmpeg().av_packet_alloc());
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::write(const std::uint8_t* i420) {
  AVFrame& frame = *streams_->frame;
  check_ffmpeg(ffmpeg().av_frame_make_writable(&frame), "no memory for a frame");
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
  check_written(ffmpeg().av_write_trailer(streams_->format.get()), path_);
  // An earlier write error is recorded only here.
  check_written(streams_->format->pb->error, path_);
  check_written(ffmpeg().avio_closep(&streams_->format->pb), path_);
  write_atomically(path_, read_file(streams_->file.path()));
  streams_.reset();
}

}  // namespace touchdown::render
