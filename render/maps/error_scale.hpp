#pragma once

#include <array>
#include <string>

namespace touchdown::render {

// Success rates of good estimators lie so close to one that they look alike; their error rates lie
// a factor of ten apart. All maps draw these, in percent, on one logarithmic scale: the same colour
// is the same error in every engine, experiment and figure.

/// Ends of the scale (%); what lies beyond has the end's colour.
inline constexpr double lowest_error = 0.3, highest_error = 30.0;
/// Where lines are drawn between cells (%).
inline constexpr std::array<double, 4> error_levels = {1.0, 2.0, 5.0, 10.0};

/// What is not right (%), to the millionth: the difference alone would say 1.0999999999999899.
double error_percent(double success);

/// "0.42", "1.38", "12.3": three digits from 1 % on; a dash for NaN.
std::string error_text(double percent);

/// A colour (#rrggbb), and whether dark text is readable on it.
struct MapColour {
  std::string hex;
  bool light;
};
/// Of an error rate (%): bright where it is low.
MapColour error_colour(double percent);

}  // namespace touchdown::render
