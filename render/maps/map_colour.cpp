#include "render/maps/map_colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "render/palette.hpp"

namespace touchdown::render {

MapColour map_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (cividis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), cividis.size() - 2);
  const double fraction = at - static_cast<double>(below);
  std::array<double, 3> linear{};
  std::string hex = "#";
  for (std::size_t i = 0; i < 3; ++i) {
    const unsigned shift = 16U - 8U * static_cast<unsigned>(i);
    const double from = cividis[below] >> shift & 255U, to = cividis[below + 1] >> shift & 255U;
    const double part = std::round(from + fraction * (to - from));
    hex += fmt::format("{:02x}", static_cast<unsigned>(part));
    linear[i] = std::pow((part / 255.0 + 0.055) / 1.055, 2.4);
  }
  // Where white and black text have the same contrast.
  return {hex, 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2] > 0.179};
}

}  // namespace touchdown::render
