#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "apps/viewer/live_run.hpp"
#include "render/film/plots.hpp"
#include "render/film/strip.hpp"

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
  /// Fits the range of torques to one of them (N·m).
  void widen(float torque);

  double period_;
  std::size_t count_ = 0;               ///< samples
  std::vector<render::StripRow> rows_;  ///< until the first picture
  std::unique_ptr<render::SignalStrip> strip_;
  cv::Mat image_;
};

/// The contact of both wheels as two small boxes: filled in contact, empty without. A decision that
/// differs from the true contact has a red border.
struct ContactBadges {
  std::array<bool, 2> contact;
  std::array<bool, 2> wrong = {false, false};
};

/// A bar that the mouse sets.
struct PanelSlider {
  int number;    ///< what it sets; the user of the panel numbers its sliders
  double share;  ///< 0 to 1
};

struct PanelLine {
  std::string text;
  std::string value = {};  ///< at the right
  bool heading = false;
  render::Colour colour = render::strip_ink;  ///< of the text
  std::optional<ContactBadges> badges = {};   ///< at the right, left of the value
  std::optional<PanelSlider> slider = {};     ///< below the text
};

/// Draws the lines on paper of this size.
cv::Mat panel(const render::TextPen& pen, const std::vector<PanelLine>& lines, int width,
              int height);

/// The slider at this place of the panel (px), with the share that it gets there.
std::optional<PanelSlider> slider_at(const std::vector<PanelLine>& lines, int width, int height,
                                     double x, double y);
/// The share that a slider gets at this place.
double slider_share(int width, double x);

}  // namespace touchdown::viewer
