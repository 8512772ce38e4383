#pragma once

#include <string>
#include <vector>

#include "render/csv_file.hpp"

namespace touchdown {

/// Two noise levels that a study combines, as the table's columns.
struct NoiseGrid {
  std::string x_column, y_column;
  std::string x_label, y_label;
  std::string x_unit, y_unit;
  std::string x_name, y_name;
};

/// The distinct numbers in a column, ascending.
std::vector<double> noise_levels(const std::vector<TableRow>& rows, const std::string& column);

/// One grid: a choice of estimators, a map per engine and estimator, a line that reads out a cell.
std::string grid_html(const std::vector<TableRow>& rows, const NoiseGrid& grid,
                      const std::string& name);

}  // namespace touchdown
