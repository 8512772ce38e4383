#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimator/bayes/measurement_model.hpp"
#include "experiments/results/drops.hpp"
#include "experiments/results/result.hpp"
#include "render/gnuplot/figure.hpp"

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

// The drawers of these figures, for data of any origin. Files as `draw_figure`. Errors:
// `InputError` without anything to draw, and where stated; `Error` as `draw_figure`.

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
};

/// The maps that `draw_heatmaps` draws for every engine of an experiment.
std::vector<NoiseMaps> noise_maps(const experiments::Experiment& experiment);

/// The estimators with a panel in these maps, in this order.
std::vector<std::string> mapped_estimators(const experiments::Experiment& experiment);

/// The rows of `experiments::ScoreTables::cells` in these maps of an engine, with a column `loses`:
/// "yes" where always contact is at least as accurate, else "no".
Table mapped_cells(const Table& cells, const NoiseMaps& maps, const std::string& simulator);

/// The maps of these `mapped_cells`, without a caption: the metric of the experiment's maps, with
/// crosses on the losers among success rates.
experiments::FigureSpec map_figure(const Table& cells, const NoiseMaps& maps,
                                   const experiments::Experiment& experiment,
                                   const std::string& simulator);

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

/// A reliability diagram of an engine's rows of `reliability.csv`: for each estimator the share of
/// steps in contact against the stated probability of contact, with the steps in every bin below.
experiments::FigureSpec reliability_figure(const Table& reliability,
                                           const experiments::Experiment& experiment,
                                           const std::string& simulator);

/// Likewise of `latencies.csv`: the shares of takeoffs and of landings that are found up to a
/// latency.
experiments::FigureSpec latency_figure(const Table& latencies,
                                       const experiments::Experiment& experiment,
                                       const std::string& simulator);

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
