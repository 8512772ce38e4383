#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimator/bayes/measurement_model.hpp"
#include "experiments/results/drops.hpp"
#include "experiments/results/result.hpp"
#include "render/gnuplot/figure.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::render {

/// Draws maps of the success rate into the run directory, for every engine: over the noise grid
/// with one panel per estimator, and over knee and wheel torque noise if there is such a grid.
/// `stop`, here and below, may be null and is looked at between figures.
void draw_heatmaps(const experiments::ExperimentResult& result, const std::atomic<bool>* stop);

/// Draws for every engine the measurement models that were fitted to its runs.
void draw_densities(const experiments::ExperimentResult& result, const std::atomic<bool>* stop);

/// Draws for every engine reliability diagrams and latencies at the highlighted noise settings,
/// both wheels pooled.
void draw_scores(const experiments::ExperimentResult& result, const std::atomic<bool>* stop);

/// Draws the drop that the experiment's section `detail` selects, for every engine. An engine
/// without such a drop gets no figure, and one line on the error stream states the reason; the
/// experiment continues.
void draw_drop_details(const experiments::ExperimentResult& result, const std::atomic<bool>* stop);

// Success rates of good estimators are so close to 100 % that their colours would look alike, while
// their distances from it differ by a factor of ten. The colours of all maps are therefore
// logarithmic in this distance, the error in percent: a colour means the same success rate in every
// engine, experiment and figure.

/// Ends of the scale (%); errors beyond have the end's colour.
inline constexpr double lowest_error = 0.1, highest_error = 30.0;

/// The error of a success rate from 0 to 1 (%), rounded to the millionth: the difference alone
/// would be 1.0999999999999899.
double error_percent(double success);
/// The success rate of an error, both in %.
inline double success_of(double error) { return std::round(1e6 * (100.0 - error)) / 1e6; }

/// The success rate of an error (%): "99.58", "87.70"; a dash for NaN.
std::string success_text(double error);

/// Whether the colour of an error (%) is light enough for dark text. It is bright for a low error.
bool is_light(double error);

// The drawers of these figures, for data of any origin. Files as `draw_figure`. Errors:
// `InputError` without anything to draw, and where stated; `Error` as `draw_figure`.

/// One map of errors (%): `value[row][column]` for the figure's y[row] and x[column]; NaN
/// where unknown. `low` and `high` are the ends of each cell's interval; `marked` cells are
/// crossed. All three may be empty.
struct HeatmapPanel {
  std::string title;
  std::vector<std::vector<double>> value;
  std::vector<std::vector<double>> low = {}, high = {};
  std::vector<std::vector<bool>> marked = {};
};

/// Maps of success rates over the same two quantities, side by side, on the common colour scale.
/// Maps of up to 64 cells show each cell's number, and its interval where there is one and it fits.
/// For finer maps only the data file contains the numbers.
struct Heatmap {
  std::string title;
  std::string x_label, y_label;  ///< with units
  std::vector<double> x, y;
  std::vector<HeatmapPanel> panels;
  std::string caption;  ///< the runs, the seeds, and what counts as contact
  std::string value_label = "success rate";
};

/// Maps with more cells than this show no numbers.
inline constexpr std::size_t most_numbered_cells = 64;

/// A noise level that maps vary.
struct NoiseAxis {
  const char* column;  ///< of `experiments::ScoreTables::cells`
  const char* unit;
  const char* name;   ///< in a sentence
  const char* title;  ///< of the axis
  std::vector<double> levels;
};

/// The maps over a grid of two noise levels: `figures/<name>_<engine>`, with a panel per estimator.
struct NoiseMaps {
  std::string name;
  std::string title;
  NoiseAxis x, y;
  std::optional<double> accelerometer = {};  ///< where it is no axis (m/s²)

  /// The scores in a cell of a panel with these rows; null where the study has none.
  const TableRow* cell(const std::vector<TableRow>& cells, double at_x, double at_y) const;
};

/// The rows of `experiments::ScoreTables::cells` about one estimator in one engine.
std::vector<TableRow> mapped_cells(const experiments::ScoreTables& tables,
                                   const std::string& simulator, const std::string& estimator);

/// The maps that `draw_heatmaps` draws for every engine of an experiment.
std::vector<NoiseMaps> noise_maps(const experiments::Experiment& experiment);

/// The estimators with a panel in these maps, in this order.
std::vector<std::string> mapped_estimators(const experiments::Experiment& experiment);

/// Draws a heatmap with panels of y × x values.
Figure draw_heatmap(const Heatmap& heatmap, const FigureFile& target);

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

Figure draw_density_figure(const DensityFigure& figure, const FigureFile& target);

/// The latencies of one estimator.
struct ScoreRow {
  std::string name;
  std::size_t line_type = 1;  ///< `line_type_of` the estimator
  scoring::TransitionCounts takeoff, landing;
};

/// One noise setting.
struct ScorePanel {
  std::string title;
  std::vector<ScoreRow> rows;  ///< the same estimators in every panel
};

/// A figure of scores, with panels for each noise setting.
struct ScoreFigure {
  std::string title;
  std::vector<ScorePanel> panels;
  std::string caption;
};

/// A reliability diagram of an engine's rows of `reliability.csv`: for each estimator the share of
/// steps in contact against the stated probability of contact, with the steps in every bin below.
experiments::FigureSpec reliability_figure(const Table& reliability,
                                           const experiments::Experiment& experiment,
                                           const std::string& simulator);

/// Draws the distributions of takeoff and landing latencies: a histogram per estimator, one pair of
/// panels per noise setting. Early detections have negative latency.
Figure draw_latency_figure(const ScoreFigure& figure, const FigureFile& target);

/// Draws one drop with a column per noise setting: height, true and noisy torques, contact
/// probabilities, spectrograms with power and median frequency, transition probabilities. A tint
/// marks the true contact of the left wheel. `estimators` are all estimators of the experiment;
/// they determine the colours. The data are `<stem>_<n>.dat` per setting
/// and, as `spectrum_text`, `<stem>_spectrum_<n>.dat`, number 0 being noiseless.
Figure draw_drop_detail(const experiments::DropDetail& detail,
                        const std::vector<std::string>& estimators, const FigureText& text,
                        const FigureFile& target);

/// A spectrogram as a matrix for gnuplot, in dB of m²/s⁴: a row per eighth of an octave with the
/// nearest frequency bin, and a column per `spectrum_stride`-th step.
std::string spectrum_text(const experiments::SpectrumTrace& trace, double bin_width);

}  // namespace touchdown::render
