#pragma once

#include <string>
#include <vector>

namespace touchdown::render {

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

/// Commands that tint the time in which `contact` holds, behind what is drawn, and mark its edges
/// in front of pictures. `time` in ms, one entry per step.
std::string contact_bands(const std::vector<double>& time, const std::vector<bool>& contact);

}  // namespace touchdown::render
