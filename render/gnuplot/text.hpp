#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::render {

/// `text` as a gnuplot string constant: nothing in it is markup, substitution or the string's end.
std::string gnuplot_text(std::string_view text);

/// The names of rows, the first one on top, as the tics of an axis on which the last one stands at
/// 0.
std::string row_tics(const std::vector<std::string>& names);

/// A number for a data file: all digits, NaN as gnuplot reads it.
std::string number(double value);

/// `text` broken into lines of at most `columns` characters.
std::string wrapped(std::string_view text, std::size_t columns);

/// Columns of a data file, by name.
class PlotColumns {
 public:
  void add(std::string name, std::vector<double> values);

  /// The number that a script knows the column by, from 1. Errors: `Error` without such a column.
  int number_of(const std::string& name) const;
  /// A line of names after `#`, then one line per step. Columns must have the same length.
  std::string text() const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;
};

/// Seconds as the milliseconds of a time axis.
std::vector<double> in_ms(std::vector<double> seconds);

/// Commands that tint the time in which `contact` holds, behind what is drawn, and mark its edges
/// in front of pictures. `time` in ms, one entry per step.
std::string contact_bands(const std::vector<double>& time, const std::vector<bool>& contact);

}  // namespace touchdown::render
