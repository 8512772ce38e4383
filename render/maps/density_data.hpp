#pragma once

#include <array>
#include <string>
#include <vector>

#include "estimator/bayes/measurement_model.hpp"

namespace touchdown::render {

/// A measurement model and whose it is.
struct DensityRow {
  std::string title;
  LikelihoodGrids grids;
};

/// The paper's Fig. 3: densities of torques in contact and in the air, and the probability of
/// contact that they imply when both are as likely beforehand; one row per model.
struct DensityFigure {
  std::string title;
  std::vector<DensityRow> rows;
  std::string caption;
};

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

}  // namespace touchdown::render
