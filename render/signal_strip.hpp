#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "render/text.hpp"

namespace touchdown {

/// One line of a plot.
struct StripCurve {
  std::string label;
  Colour colour;
  std::vector<float> values;  ///< one per row of the recording; NaN leaves a gap
  bool emphasis = true;       ///< false: thin and without a dot
};

/// One plot: curves over bands that say what was true.
struct StripRow {
  std::string title;
  float low = 0.0f, high = 1.0f;
  std::vector<StripCurve> curves;
  /// Per row of the recording, how many wheels were truly in contact; may be empty.
  std::vector<std::uint8_t> wheels_in_contact;
  double period = 1e-3;  ///< between rows (s)
};

/// Plots that run along below the view: a window of 4 s with the present at three quarters, the
/// future faded. A plot is drawn once, at twice the size and tile by tile, and then only moved.
class SignalStrip {
 public:
  /// Of `width`·`height` pixels.
  SignalStrip(std::vector<StripRow> rows, int width, int height);

  /// Draws into `image`, whose size must be width·height (8UC4), as of `time` (s).
  void draw(cv::Mat image, double time);

 private:
  struct Area {
    int top, bottom;
  };

  double pixels_per_second() const;
  const cv::Mat& tile(int number);
  cv::Mat window(double from);
  void draw_labels();
  float y(const StripRow& row, const Area& area, float value) const;

  std::vector<StripRow> rows_;
  int width_, height_;
  int left_, right_;  ///< of the plots
  std::vector<Area> areas_;
  TextPen pen_;
  cv::Mat background_;
  std::map<int, cv::Mat> tiles_;
};

}  // namespace touchdown
