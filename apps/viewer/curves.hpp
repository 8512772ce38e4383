#pragma once

#include <vector>

#include "apps/viewer/screen.hpp"
#include "render/film/plots.hpp"

namespace touchdown::viewer {

/// The steps that lanes and curves show: step `first` is at `left` (px).
struct LaneScale {
  double first = 0.0, steps_per_pixel = 1.0;
  float left = 0.0F, width = 0.0F;

  float x(double step) const { return left + static_cast<float>((step - first) / steps_per_pixel); }
  double step(double x) const { return first + (x - left) * steps_per_pixel; }
};

/// The scale of plots in an area, right of their names, that show so many steps.
LaneScale scale_of(const Area& area, double first, double steps);

/// Draws a plot of each row below the last one into the present window of widgets: curves over
/// bands of true contact, with dots at step `present`. `fades`: the future is paler.
void draw_curves(const std::vector<render::StripRow>& rows, const LaneScale& scale,
                 const Area& area, double present, bool fades);

}  // namespace touchdown::viewer
