#include "estimator/numerics/axis.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "estimator/numerics/number_text.hpp"

namespace touchdown {

Axis axis_from_points(std::span<const double> points) {
  if (points.size() < 2) throw InputError("a grid axis needs at least two points");
  const Axis axis{points.front(), points.back(), static_cast<int>(points.size())};
  check_axis(axis, "points");
  constexpr double most_apart = 1e-3;  // steps: the effect of rounding to float32 or six decimals
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double expected = axis[static_cast<int>(i)];
    if (!(std::abs(points[i] - expected) <= most_apart * axis.step())) {
      throw InputError("a grid axis must be equally spaced; point " + std::to_string(i) + " is " +
                       text_of(points[i]) + ", expected " + text_of(expected));
    }
  }
  return axis;
}

void check_axis(const Axis& axis, const char* name) {
  if (axis.count < 2 || !std::isfinite(axis.lower) || !std::isfinite(axis.upper) ||
      !(axis.lower < axis.upper)) {
    throw InputError(std::string(name) + " axis: expected two or more points from a finite lower " +
                     "end to a greater finite upper end, got " + std::to_string(axis.count) +
                     " from " + text_of(axis.lower) + " to " + text_of(axis.upper));
  }
}

}  // namespace touchdown
