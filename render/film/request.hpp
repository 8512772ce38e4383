#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "render/film/source.hpp"

namespace touchdown::render {

enum class VideoQuality : int {
  draft,  ///< no anti-aliasing in the view
  page,   ///< drawn at twice the size and averaged
};

struct VideoOptions {
  int width = 1280;
  int height = 720;
  int fps = 30;
  VideoQuality quality = VideoQuality::draft;
  double from = 0.0;                                    ///< of the recording (s)
  double to = std::numeric_limits<double>::infinity();  ///< of the recording (s)
  double speed = 1.0;                                   ///< 0.1: ten times slower than life
  int crf = 21;                                         ///< of H.264: higher is smaller and worse
  std::string encoder = "libx264";                      ///< FFmpeg's name of it
  int workers = 0;                                      ///< processes; 0: one per core
  scoring::LabelConfig labels = {};                     ///< what counts as true contact
  /// Called after every frame; may be empty.
  std::function<void(int done, int of)> progress = {};
};

/// Throws `InputError`, saying what is wrong, if these runs cannot be drawn so.
void require_drawable(const std::vector<VideoSource>& sources, const VideoOptions& options);

}  // namespace touchdown::render
