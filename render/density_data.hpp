#pragma once

#include <array>
#include <string>

#include "render/density_figure.hpp"
#include "render/density_grid.hpp"

namespace touchdown {

/// The shares of a density's probability that its lines enclose.
inline constexpr std::array<double, 3> enclosed_shares = {0.5, 0.9, 0.99};
/// The probabilities of contact that have a line: undecided, and the filter's decision.
inline constexpr std::array<double, 2> probability_levels = {0.5, 0.8};
/// A density is drawn down to this share of its peak.
inline constexpr double faintest = 1e-4;

/// A density figure's data file, and where its blocks (gnuplot's `index`) are. Of each row, first
/// the points: knee torque, wheel torque, both densities as shares of their peaks, P(contact);
/// then the lines of both densities and of the probability.
std::string density_data(const DensityFigure& figure);
inline constexpr std::size_t density_blocks = 4;  ///< per row

/// Ends of the drawn axes (N·m).
struct DensityAxes {
  double knee_low, knee_high, wheel_low, wheel_high;
};
DensityAxes axes_of(const LikelihoodGrids& grids);

}  // namespace touchdown
