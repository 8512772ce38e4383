#include "render/maps/density_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace touchdown::render {
namespace {

/// The points of `grid` that are not below `level`, as a window.
void widen(GridWindow& window, const std::vector<double>& grid, int row_length, double level) {
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (!(grid[i] >= level)) continue;
    const int row = static_cast<int>(i) / row_length, column = static_cast<int>(i) % row_length;
    if (window.rows == 0) {
      window = {row, 1, column, 1};
      continue;
    }
    const int last_row = std::max(window.first_row + window.rows - 1, row);
    const int last_column = std::max(window.first_column + window.columns - 1, column);
    window.first_row = std::min(window.first_row, row);
    window.first_column = std::min(window.first_column, column);
    window.rows = last_row - window.first_row + 1;
    window.columns = last_column - window.first_column + 1;
  }
}

void add_margin(int& first, int& length, int count) {
  const int margin = std::max(2, length / 8);
  const int last = std::min(count - 1, first + length - 1 + margin);
  first = std::max(0, first - margin);
  length = last - first + 1;
}

}  // namespace

double density_level(const std::vector<double>& grid, double share) {
  std::vector<double> sorted = grid;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const double all = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  if (!(all > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const double value : sorted) {
    sum += value;
    if (sum >= share * all) return value;
  }
  return sorted.back();
}

DensityPeaks peaks_of(const LikelihoodGrids& grids) {
  constexpr double vanishing = 1e-12;
  DensityPeaks peaks{*std::max_element(grids.contact.begin(), grids.contact.end()),
                     *std::max_element(grids.no_contact.begin(), grids.no_contact.end())};
  const double highest = std::max(peaks.contact, peaks.no_contact);
  if (peaks.contact < vanishing * highest) peaks.contact = 0.0;
  if (peaks.no_contact < vanishing * highest) peaks.no_contact = 0.0;
  return peaks;
}

GridWindow window_of(const LikelihoodGrids& grids, double share) {
  const DensityPeaks peaks = peaks_of(grids);
  GridWindow window;
  for (const auto& [grid, peak] :
       {std::pair(&grids.contact, peaks.contact), std::pair(&grids.no_contact, peaks.no_contact)}) {
    if (peak > 0.0) widen(window, *grid, grids.knee.count, density_level(*grid, share));
  }
  if (window.rows == 0) return {0, grids.wheel.count, 0, grids.knee.count};
  add_margin(window.first_row, window.rows, grids.wheel.count);
  add_margin(window.first_column, window.columns, grids.knee.count);
  return window;
}

std::vector<std::vector<double>> rows_of(const std::vector<double>& grid, int row_length,
                                         const GridWindow& window) {
  std::vector<std::vector<double>> rows;
  for (int r = window.first_row; r < window.first_row + window.rows; ++r) {
    const auto begin = grid.begin() + r * row_length + window.first_column;
    rows.emplace_back(begin, begin + window.columns);
  }
  return rows;
}

}  // namespace touchdown::render
