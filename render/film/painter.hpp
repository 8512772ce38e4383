#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/request.hpp"
#include "render/film/scene_view.hpp"
#include "render/offscreen/gl_context.hpp"
#include "render/strip/signal_strip.hpp"

namespace touchdown::render {

/// Paints up to `most_sources` runs at a point in time: views side by side and, if `annotated`,
/// labels on them and the strip below. The picture depends on the time alone, not on previous ones.
class FramePainter {
 public:
  /// Creates the process's OpenGL context. Keeps the sources' references.
  FramePainter(const std::vector<VideoSource>& sources, const VideoOptions& options,
               bool annotated = true);
  ~FramePainter();

  /// The picture (8UC3, BGR) at `time` of the recordings (s). Valid until the next call.
  const cv::Mat& paint(double time);

 private:
  struct Show;
  void paint_labels(const Show& show, std::size_t row, double time, int left, int view_top);

  VideoOptions options_;
  int strip_height_;  ///< 0 without one
  GlContext gl_;
  std::vector<std::unique_ptr<Show>> shows_;
  std::unique_ptr<SignalStrip> strip_;
  TextPen pen_;
  cv::Mat averaged_;
  cv::Mat picture_;
};

}  // namespace touchdown::render
