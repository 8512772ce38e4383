#pragma once

#include <string>
#include <vector>

#include "estimator/bayes/measurement_model.hpp"

namespace touchdown::render {

/// The density above which `share` of a grid's sum lies: the border of its highest-density region.
/// NaN for a grid of zeros.
double density_level(const std::vector<double>& grid, double share);

/// The part of a grid that is drawn: rows along the wheel's axis, columns along the knee's.
struct GridWindow {
  int first_row = 0, rows = 0, first_column = 0, columns = 0;
};
/// Where `share` of both densities lies, with a margin around it. One that vanishes counts as not
/// there.
GridWindow window_of(const LikelihoodGrids& grids, double share);

/// Both densities' peaks; zero for one that vanishes beside the other, as when all its torques lie
/// outside the model's axes.
struct DensityPeaks {
  double contact = 0.0, no_contact = 0.0;
};
DensityPeaks peaks_of(const LikelihoodGrids& grids);

/// A grid's window as nested rows, for `iso_lines`.
std::vector<std::vector<double>> rows_of(const std::vector<double>& grid, int row_length,
                                         const GridWindow& window);

}  // namespace touchdown::render
