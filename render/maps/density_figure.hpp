#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "estimator/bayes/measurement_model.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// A measurement model and the estimators that use it.
struct DensityRow {
  std::string title;  ///< the estimators
  LikelihoodGrids grids;
};

/// The paper's Fig. 3: densities of torques in contact and in the air, and the contact probability
/// that follows from a flat prior; one row per model.
struct DensityFigure {
  std::string title;
  std::vector<DensityRow> rows;
  std::string caption;
};

/// The level of a grid's highest-density region: values above it add up to `share` of the grid's
/// sum. NaN for a grid of zeros.
double density_level(const std::vector<double>& grid, double share);

/// Both densities' peaks. A density that is negligible beside the other counts as zero, for example
/// when all its torques lie outside the model's axes.
struct DensityPeaks {
  double contact = 0.0, no_contact = 0.0;
};
DensityPeaks peaks_of(const LikelihoodGrids& grids);

/// Ends of the drawn axes (N·m).
struct DensityAxes {
  double knee_low, knee_high, wheel_low, wheel_high;
};
DensityAxes axes_of(const LikelihoodGrids& grids);

/// Draws a density figure. Files as `draw_figure`. Errors: `InputError` without rows; `Error` as
/// `draw_figure`.
Figure draw_density_figure(const DensityFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown::render
