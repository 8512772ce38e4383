#include "estimator/numerics/axis.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"

namespace touchdown {

Axis axis_from_points(std::span<const double> points) {
  if (points.size() < 2) throw InputError("a grid axis needs at least two points");
  const Axis axis{points.front(), points.back(), static_cast<int>(points.size())};
  check_axis(axis, "points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(std::abs(points[i] - axis[static_cast<int>(i)]) <= 1e-6 * axis.step())) {
      throw InputError("a grid axis must be equally spaced; point " + std::to_string(i) + " is " +
                       std::to_string(points[i]) + ", expected " +
                       std::to_string(axis[static_cast<int>(i)]));
    }
  }
  return axis;
}

void check_axis(const Axis& axis, const char* name) {
  if (axis.count < 2 || !std::isfinite(axis.lower) || !std::isfinite(axis.upper) ||
      !(axis.lower < axis.upper)) {
    throw InputError(std::string(name) + " axis: expected two or more points from a finite lower " +
                     "end to a greater finite upper end, got " + std::to_string(axis.count) +
                     " from " + std::to_string(axis.lower) + " to " + std::to_string(axis.upper));
  }
}

}  // namespace touchdown
