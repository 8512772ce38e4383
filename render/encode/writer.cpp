#include "render/encode/writer.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/encode/memory_file.hpp"

namespace touchdown::render {

struct VideoWriter::Streams {
  MemoryFile file;
  FormatHandle format;
  CodecHandle codec;
  FrameHandle frame;
  PacketHandle packet;
  AVStream* stream = nullptr;
  std::int64_t frames = 0;

  /// Give the encoder a frame (or null: there are no more) and write what it has ready.
  void encode(const AVFrame* next) {
    check_ffmpeg(avcodec_send_frame(codec.get(), next), "the encoder refuses a frame");
    while (true) {
      const int result = avcodec_receive_packet(codec.get(), packet.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      check_ffmpeg(result, "the encoder failed");
      av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
      packet->duration = av_rescale_q(1, codec->time_base, stream->time_base);
      packet->stream_index = stream->index;
      check_ffmpeg(av_interleaved_write_frame(format.get(), packet.get()), "cannot write");
    }
  }
};

VideoWriter::VideoWriter(std::filesystem::path path, const VideoFormat& video)
    : path_(std::move(path)), streams_(std::make_unique<Streams>()) {
  require_writable(path_);
  AVFormatContext* format = nullptr;
  check_ffmpeg(
      avformat_alloc_output_context2(&format, nullptr, "mp4", streams_->file.path().c_str()),
      "cannot make an mp4");
  streams_->format.reset(format);
  format->flags |= AVFMT_FLAG_BITEXACT;
  streams_->codec = start_encoder(video, (format->oformat->flags & AVFMT_GLOBALHEADER) != 0);
  const AVCodecContext& codec = *streams_->codec;

  streams_->stream = avformat_new_stream(format, nullptr);
  if (!streams_->stream) throw Error("video: no memory for a stream");
  streams_->stream->time_base = codec.time_base;
  streams_->stream->avg_frame_rate = codec.framerate;
  check_ffmpeg(avcodec_parameters_from_context(streams_->stream->codecpar, &codec), "parameters");
  check_ffmpeg(avio_open(&format->pb, streams_->file.path().c_str(), AVIO_FLAG_WRITE),
               "cannot open");
  AVDictionary* options = nullptr;
  av_dict_set(&options, "movflags", "+faststart", 0);
  const int header = avformat_write_header(format, &options);
  av_dict_free(&options);
  check_ffmpeg(header, "cannot begin the file");
  streams_->frame = make_frame(codec);
  streams_->packet.reset(av_packet_alloc());
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::write(const std::uint8_t* i420) {
  AVFrame& frame = *streams_->frame;
  check_ffmpeg(av_frame_make_writable(&frame), "no memory for a frame");
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
  check_ffmpeg(av_write_trailer(streams_->format.get()), "cannot finish the file");
  check_ffmpeg(avio_closep(&streams_->format->pb), "cannot finish the file");
  write_atomically(path_, read_file(streams_->file.path()));
  streams_.reset();
}

}  // namespace touchdown::render
