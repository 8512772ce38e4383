#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "render/encode/encoder.hpp"

namespace touchdown::render {

/// Encodes frames into an H.264 mp4 that browsers play while it loads (index in front). The file is
/// made in memory and appears, whole, with `finish`; without it nothing is left behind. The same
/// frames give the same bytes. Errors: as `start_encoder`, and `Error` for a path that cannot be
/// written; both are noticed when the writer is made.
class VideoWriter {
 public:
  VideoWriter(std::filesystem::path path, const VideoFormat& format);
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

}  // namespace touchdown::render
