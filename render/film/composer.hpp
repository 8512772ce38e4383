#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/request.hpp"
#include "render/strip/signal_strip.hpp"

namespace touchdown::render {

/// The row of a recording at `time` (s).
std::size_t row_at(const recordings::Recording& recording, double time);

/// The size of the only view in the pictures of a film with labels and strip (px).
cv::Size single_view_size(const VideoOptions& options);

/// Composes the pictures of one film: up to `most_sources` views in a grid and, if `annotated`,
/// labels on them and the strip below.
class FrameComposer {
 public:
  /// Keeps the sources' references.
  FrameComposer(const std::vector<VideoSource>& sources, const VideoOptions& options,
                bool annotated);

  /// The size of each run's view in the picture (px).
  cv::Size view_size() const;

  /// Puts a view (8UC4, BGRA) in the place of run `i`. A larger view is reduced; of a wider one,
  /// the middle is shown.
  void place(std::size_t i, const cv::Mat& view);

  /// The picture (8UC3, BGR) with the placed views, labels and strip at `time` of the recordings
  /// (s). Valid until the next call.
  const cv::Mat& picture(double time);

 private:
  struct Run {
    VideoSource source;
    std::vector<std::uint8_t> contact;  ///< without states that are too short to be read
  };
  cv::Rect pane(std::size_t i) const;
  void write_labels(std::size_t i, double time);

  VideoOptions options_;
  int strip_height_;  ///< 0 without one
  std::vector<Run> runs_;
  std::unique_ptr<SignalStrip> strip_;
  TextPen pen_;
  cv::Mat reduced_;
  cv::Mat picture_;
};

}  // namespace touchdown::render
