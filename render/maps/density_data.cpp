#include "render/maps/density_data.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include <fmt/format.h>

#include "render/maps/density_grid.hpp"
#include "render/maps/iso_lines.hpp"

namespace touchdown::render {
namespace {

constexpr double window_share = 0.97;
/// More points than this along an axis are thinned out.
constexpr int most_points = 200;

std::string lines(const std::vector<std::vector<double>>& rows, double level,
                  const LikelihoodGrids& grids, const GridWindow& window) {
  std::string text;
  for (const IsoLine& line : joined(iso_lines(rows, level))) {
    for (const auto& [column, row] : line) {
      fmt::format_to(std::back_inserter(text), "{:.5g}\t{:.5g}\n",
                     grids.knee[window.first_column] + column * grids.knee.step(),
                     grids.wheel[window.first_row] + row * grids.wheel.step());
    }
    text += '\n';
  }
  return text;
}

std::string block_of_lines(const std::vector<double>& grid, std::span<const double> levels,
                           const LikelihoodGrids& grids, const GridWindow& window) {
  const auto rows = rows_of(grid, grids.knee.count, window);
  std::string text;
  for (const double level : levels) text += lines(rows, level, grids, window);
  return (text.empty() ? "NaN\tNaN\n\n" : text) + '\n';
}

std::array<double, enclosed_shares.size()> levels_of(const std::vector<double>& grid) {
  std::array<double, enclosed_shares.size()> levels{};
  std::transform(enclosed_shares.begin(), enclosed_shares.end(), levels.begin(),
                 [&](double share) { return density_level(grid, share); });
  return levels;
}

double share_of_peak(double density, double peak) {
  return peak > 0.0 ? std::max(density / peak, faintest) : faintest;
}

std::string points(const LikelihoodGrids& grids, const std::vector<double>& probability,
                   const GridWindow& window) {
  const DensityPeaks peaks = peaks_of(grids);
  const int row_step = 1 + (window.rows - 1) / most_points;
  const int column_step = 1 + (window.columns - 1) / most_points;
  std::string text = "#knee_nm\twheel_nm\tcontact\tno_contact\tp_contact\n";
  for (int r = window.first_row; r < window.first_row + window.rows; r += row_step) {
    for (int c = window.first_column; c < window.first_column + window.columns; c += column_step) {
      const auto i = static_cast<std::size_t>(r * grids.knee.count + c);
      fmt::format_to(std::back_inserter(text), "{:.5g}\t{:.5g}\t{:.4g}\t{:.4g}\t{:.4g}\n",
                     grids.knee[c], grids.wheel[r], share_of_peak(grids.contact[i], peaks.contact),
                     share_of_peak(grids.no_contact[i], peaks.no_contact), probability[i]);
    }
  }
  return text + "\n\n";
}

}  // namespace

DensityAxes axes_of(const LikelihoodGrids& grids) {
  const GridWindow window = window_of(grids, window_share);
  return {grids.knee[window.first_column], grids.knee[window.first_column + window.columns - 1],
          grids.wheel[window.first_row], grids.wheel[window.first_row + window.rows - 1]};
}

std::string density_data(const DensityFigure& figure) {
  std::string text;
  for (const DensityRow& row : figure.rows) {
    const LikelihoodGrids& grids = row.grids;
    const GridWindow window = window_of(grids, window_share);
    const std::vector<double> probability = contact_probability(grids);
    text += points(grids, probability, window);
    text += block_of_lines(grids.contact, levels_of(grids.contact), grids, window);
    text += block_of_lines(grids.no_contact, levels_of(grids.no_contact), grids, window);
    text += block_of_lines(probability, probability_levels, grids, window);
  }
  return text;
}

}  // namespace touchdown::render
