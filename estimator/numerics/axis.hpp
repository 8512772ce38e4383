#pragma once

#include <algorithm>
#include <span>

namespace touchdown {

/// The position of a value on an axis: between the points `index` and `index + 1`, the fraction
/// `weight` in [0, 1] of the way to the second one.
struct AxisPosition {
  int index = 0;
  double weight = 0.0;
};

/// A regular axis of a lookup grid: `count` ≥ 2 points from `lower` to `upper`, both included
/// (in the unit of what it measures; N·m for torques).
struct Axis {
  double lower = 0.0;
  double upper = 1.0;
  int count = 200;

  [[nodiscard]] double step() const noexcept { return (upper - lower) / (count - 1); }
  [[nodiscard]] double operator[](int index) const noexcept { return lower + index * step(); }

  bool operator==(const Axis&) const = default;
};

/// The axis through the given points, as from a file.
/// Throws InputError unless there are two or more, finite, increasing and equally spaced to 1e-6 of
/// a step.
Axis axis_from_points(std::span<const double> points);

/// Throws InputError unless the axis has two or more points, finite ends and lower < upper.
void check_axis(const Axis& axis, const char* name);

/// The axis prepared for lookups without a division. A value outside the axis gets the position of
/// the nearest end, which extrapolates a grid by constants.
class AxisLookup {
 public:
  AxisLookup() = default;
  explicit AxisLookup(const Axis& axis) noexcept
      : lower_(axis.lower),
        inverse_step_(1.0 / axis.step()),
        last_(axis.count - 1),
        last_cell_(axis.count - 2) {}

  [[nodiscard]] AxisPosition place(double value) const noexcept {
    // The order of the comparisons sends NaN to the lower end instead of out of bounds.
    const double steps = std::min(last_, std::max(0.0, (value - lower_) * inverse_step_));
    const int index = std::min(static_cast<int>(steps), last_cell_);
    return {index, steps - index};
  }

 private:
  double lower_ = 0.0;
  double inverse_step_ = 1.0;
  double last_ = 1.0;
  int last_cell_ = 0;
};

}  // namespace touchdown
