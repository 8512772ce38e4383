#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "render/writable.hpp"

namespace touchdown {

/// Encodes frames into an H.264 mp4 that browsers play while it loads (x264 veryfast, crf 21 by
/// default, 4:2:0, a key frame every 2 s, index in front). The file is made in memory and appears,
/// whole, with `finish`; without it nothing is left behind. The same frames give the same bytes.
/// Errors: `Error` for a missing encoder or a path that cannot be written; the latter is noticed
/// when the writer is made.
class VideoWriter {
 public:
  /// Width and height must be even.
  VideoWriter(std::filesystem::path path, int width, int height, int fps, int crf = 21);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// One frame of width·height·3/2 bytes: planes Y, U, V (BT.601, limited range).
  void write(const std::uint8_t* i420);
  void finish();

 private:
  struct Streams;
  std::filesystem::path path_;
  std::unique_ptr<Streams> streams_;
};

}  // namespace touchdown
