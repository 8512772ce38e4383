#include "render/figures/error_scale.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/palette.hpp"

namespace touchdown::render {

double error_percent(double accuracy) { return std::round(1e8 * (1.0 - accuracy)) / 1e6; }

std::string error_text(double percent) {
  if (!std::isfinite(percent)) return "–";
  // A value that would round to 10.00 needs one digit less.
  return fmt::format("{:.{}f}", percent, percent < 9.995 ? 2 : 1);
}

MapColour error_colour(double percent) {
  const double clamped = std::clamp(percent, lowest_error, highest_error);
  const double share = std::log(highest_error / clamped) / std::log(highest_error / lowest_error);
  const double at = share * (viridis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  const double fraction = at - static_cast<double>(below);
  std::array<double, 3> linear{};
  std::string hex = "#";
  for (std::size_t i = 0; i < 3; ++i) {
    const unsigned shift = 16U - 8U * static_cast<unsigned>(i);
    const double from = viridis[below] >> shift & 255U, to = viridis[below + 1] >> shift & 255U;
    const double part = std::round(from + fraction * (to - from));
    hex += fmt::format("{:02x}", static_cast<unsigned>(part));
    linear[i] = std::pow((part / 255.0 + 0.055) / 1.055, 2.4);
  }
  // At this luminance, white and black text have the same contrast.
  return {hex, 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2] > 0.179};
}

}  // namespace touchdown::render
