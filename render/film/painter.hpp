#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/composer.hpp"
#include "render/film/request.hpp"
#include "render/film/scene_view.hpp"
#include "render/offscreen/gl_context.hpp"

namespace touchdown::render {

/// Paints the pictures of one or several films at a point in time. The view of each run is painted
/// once for all films. A picture depends on the time alone, not on previous ones.
class FramePainter {
 public:
  /// Creates the process's OpenGL context. Keeps the sources' references.
  FramePainter(const std::vector<VideoSource>& sources, const std::vector<Film>& films,
               bool annotated = true);
  /// One film of all sources.
  FramePainter(const std::vector<VideoSource>& sources, const VideoOptions& options,
               bool annotated = true);
  ~FramePainter();

  /// The picture (8UC3, BGR) of the first film at `time` of the recordings (s). Valid until the
  /// next call.
  cv::Mat paint(double time);

  /// Likewise of each film; an empty one for films that are not `wanted`.
  std::vector<cv::Mat> paint(double time, const std::vector<bool>& wanted);

 private:
  struct Show;
  /// The view of a run (8UC4, BGRA), valid until the next call.
  cv::Mat view(std::size_t run, double time);

  std::vector<Film> films_;
  std::vector<FrameComposer> composers_;
  GlContext gl_;  ///< as large as one view
  std::vector<std::unique_ptr<Show>> shows_;
};

}  // namespace touchdown::render
