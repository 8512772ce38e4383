#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/gl_context.hpp"
#include "render/film/pose.hpp"
#include "render/film/scene_view.hpp"
#include "render/film/source.hpp"
#include "render/strip/signal_strip.hpp"

namespace touchdown::render {

/// Which parts of the picture are wanted.
struct FrameLayout {
  int width = 1280;
  int height = 720;
  int supersampling = 1;  ///< 2: the view is drawn at twice the size
  bool strip = true;
  bool labels = true;
  double speed = 1.0;  ///< only for its label
};

/// Paints one or two runs at a point in time: views beside each other, the strip below. What it
/// paints depends on the time alone, not on what it painted before.
class FramePainter {
 public:
  /// Makes the process's OpenGL context. Keeps references to what the sources refer to.
  FramePainter(const std::vector<VideoSource>& sources, const FrameLayout& layout,
               const scoring::LabelConfig& labels);
  ~FramePainter();

  /// The picture (8UC3, BGR) at `time` of the recordings (s). Valid until the next call.
  const cv::Mat& paint(double time);

 private:
  struct Show;
  void paint_labels(const Show& show, std::size_t row, double time, int left);

  FrameLayout layout_;
  int strip_height_;
  GlContext gl_;
  std::vector<std::unique_ptr<Show>> shows_;
  std::unique_ptr<SignalStrip> strip_;
  TextPen pen_;
  cv::Mat averaged_;
  cv::Mat picture_;
};

}  // namespace touchdown::render
