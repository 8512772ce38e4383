#pragma once

#include <string>

namespace touchdown::render {

/// The colour (#rrggbb) for a share of a map's scale, and whether dark text is readable on it.
struct MapColour {
  std::string hex;
  bool light;
};
MapColour map_colour(double share);

}  // namespace touchdown::render
