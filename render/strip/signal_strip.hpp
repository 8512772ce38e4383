#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "render/strip/plots.hpp"

namespace touchdown::render {

/// Moving plots below the view: a window of 4 s with the present at three quarters and the future
/// faded. Titles and legends are left of the plots, or above them in a narrow strip.
class SignalStrip {
 public:
  /// A strip of `width`·`height` pixels.
  SignalStrip(std::vector<StripRow> rows, int width, int height);

  /// Draws the strip at `time` (s) into `image`, which must have width·height pixels (8UC3).
  void draw(cv::Mat image, double time);

 private:
  void place_rows(int header);
  void draw_ticks(std::size_t i);
  void draw_names_beside(std::size_t i);
  void draw_names_above(std::size_t i);
  void draw_legend(const StripCurve& curve, int x, int top);
  int legend_width(const StripCurve& curve) const;

  std::vector<StripRow> rows_;
  int width_, height_;
  bool narrow_;
  int letters_;       ///< height of the text
  int left_, right_;  ///< of the plots
  std::vector<PlotArea> areas_;
  TextPen pen_;
  cv::Mat background_;
  cv::Mat fog_;  ///< paper, as large as the future
  std::unique_ptr<StripPlots> plots_;
};

}  // namespace touchdown::render
