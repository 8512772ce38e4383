#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/strip/text.hpp"

namespace touchdown::render {

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

/// Colours of the strip.
inline const Colour strip_paper = rgb(0xf7f8fa);
inline const Colour strip_ink = rgb(0x22262b);

}  // namespace touchdown::render
