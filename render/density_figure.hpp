#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "estimator/measurement_model.hpp"
#include "render/gnuplot.hpp"

namespace touchdown {

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

/// Files as `draw_figure`. Errors: `InputError` without rows; `Error` as `draw_figure`.
Figure draw_density_figure(const DensityFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown
