#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <opencv2/core/mat.hpp>

namespace touchdown::render {

/// Writes a picture (8UC3, BGR) as a PNG, or as a JPEG of quality 82 for a path with `.jpg`. The
/// same picture gives the same bytes. Errors: `Error` when it cannot be compressed or written.
void write_picture(const cv::Mat& bgr, const std::filesystem::path& path);

/// The encoding of frames: x264 veryfast at constant quality `crf`, 4:2:0, BT.601, a key frame
/// every 2 s. `encoder` is FFmpeg's name of an encoder that accepts x264's options.
struct VideoFormat {
  int width = 1280, height = 720;  ///< even
  int fps = 30;
  int crf = 21;  ///< a higher value gives a smaller file of lower quality
  std::string encoder = "libx264";
};

/// Encodes frames into an H.264 mp4 that browsers can play while it loads (index in front). The
/// file is built in memory, and `finish` writes it as a whole; without `finish` no file is written.
/// The same frames give the same bytes. Errors of the constructor: `InputError` for odd sizes;
/// `Error` when FFmpeg has no such encoder, when it does not start, or when the path cannot be
/// written.
class VideoWriter {
 public:
  VideoWriter(std::filesystem::path path, const VideoFormat& format);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// Adds a frame of width·height·3/2 bytes: planes Y, U, V (BT.601, limited range).
  void write(const std::uint8_t* i420);
  /// Writes the file. Errors: `Error` when encoding or writing fails.
  void finish();

 private:
  struct Streams;
  std::filesystem::path path_;
  std::unique_ptr<Streams> streams_;
};

}  // namespace touchdown::render
