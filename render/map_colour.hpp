#pragma once

#include <string>

namespace touchdown {

/// The colour (#rrggbb) for a share of a map's scale, and whether dark text is readable on it.
/// Cividis: it stays in order for colour-blind readers and in grey print.
struct MapColour {
  std::string hex;
  bool light;
};
MapColour map_colour(double share);

}  // namespace touchdown
