#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/plots.hpp"

namespace touchdown::viewer {

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

/// One line of the panel beside the scene.
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
