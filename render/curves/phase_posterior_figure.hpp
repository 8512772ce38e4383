#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/results/drops.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws the phase filter's posterior through one drop, one column per engine: true contact of both
/// wheels, the true phase, the likelihood of every phase from one step's signals, the
/// log-likelihood error of each signal, the phase probabilities stacked in the order of `Phase`,
/// and the resulting contact probability of each wheel. Files as `draw_figure`; the data are
/// `<stem>_<n>.dat`, as intervals `<stem>_truth_<n>.dat` and, as a matrix,
/// `<stem>_likelihood_<n>.dat`. Errors: as `draw_figure`.
Figure draw_phase_posterior(const std::vector<experiments::DropPosterior>& drops,
                            const FigureText& text, const std::filesystem::path& stem);

}  // namespace touchdown::render
