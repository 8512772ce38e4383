#pragma once

#include <array>
#include <string>

namespace touchdown::render {

// Accuracies of good estimators are so close to one that their colours would look alike, while
// their error rates differ by a factor of ten. All maps therefore draw error rates, in percent, on
// one logarithmic scale: a colour means the same error in every engine, experiment and figure.

/// Ends of the scale (%); errors beyond have the end's colour.
inline constexpr double lowest_error = 0.3, highest_error = 30.0;
/// Levels at which lines are drawn between cells (%).
inline constexpr std::array<double, 4> error_levels = {1.0, 2.0, 5.0, 10.0};

/// The error rate of an accuracy (%), rounded to the millionth: the difference alone would be
/// 1.0999999999999899.
double error_percent(double accuracy);

/// "0.42", "1.38", "12.3": three digits from 1 % on; a dash for NaN.
std::string error_text(double percent);

/// A colour (#rrggbb), and whether it is light enough for dark text.
struct MapColour {
  std::string hex;
  bool light;
};
/// The colour of an error rate (%): bright where it is low.
MapColour error_colour(double percent);

}  // namespace touchdown::render
