#pragma once

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/strip.hpp"
#include "viewer/live/run.hpp"

namespace touchdown::viewer {

/// The colour (0xRRGGBB) of the i-th estimator, as in figures and films.
unsigned estimator_colour(std::size_t i);

/// Curves that grow with a live run: P(contact) of both wheels over their true contact, torques and
/// the vertical acceleration.
class LivePlots {
 public:
  /// The number of estimators; `period` between samples (s); `weight` of the robot (N).
  LivePlots(std::size_t estimators, double period, double weight);

  void append(const std::vector<LiveSample>& samples);
  /// Draws the last seconds. Valid until the next call.
  const cv::Mat& draw(int width, int height);

 private:
  double end() const;

  double period_;
  std::size_t count_ = 0;               ///< samples
  std::vector<render::StripRow> rows_;  ///< until the first picture
  std::unique_ptr<render::SignalStrip> strip_;
  cv::Mat image_;
};

}  // namespace touchdown::viewer
