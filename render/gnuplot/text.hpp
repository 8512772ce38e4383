#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::render {

/// `text` as a gnuplot string constant. No character of it acts as markup, as a substitution or as
/// the string's end.
std::string gnuplot_text(std::string_view text);

/// The name of a file in the same folder as gnuplot takes it, on its command line and in scripts: a
/// name that does not begin with a letter or a digit could be an option, a data block or a
/// command that gnuplot runs.
std::string file_argument(const std::string& name);
/// The same as a gnuplot string constant.
std::string gnuplot_file(const std::string& name);

/// The tics of a vertical axis that names rows: the first name on top, the last one at 0.
std::string row_tics(const std::vector<std::string>& names);

/// A number for a data file, with all digits; NaN is written as gnuplot reads it.
std::string number(double value);

/// `text` broken into lines of at most `columns` characters.
std::string wrapped(std::string_view text, std::size_t columns);

/// Columns of a data file, by name.
class PlotColumns {
 public:
  void add(std::string name, std::vector<double> values);

  /// The column's number in scripts, from 1. Errors: `Error` without such a column.
  int number_of(const std::string& name) const;
  /// A line of names after `#`, then one line per step. All columns have the same length.
  std::string text() const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;
};

/// Converts seconds into the milliseconds of a time axis.
std::vector<double> in_ms(std::vector<double> seconds);

/// Commands that tint the time in contact behind the curves, and mark its edges in front of images.
/// `time` is in ms, with one entry per step.
std::string contact_bands(const std::vector<double>& time, const std::vector<bool>& contact);

}  // namespace touchdown::render
