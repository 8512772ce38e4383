#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/drops/posterior.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws the phase filter's probability of every phase through one drop, one column per engine:
/// which wheels truly touch, the true phase, how likely each phase is by one step's signals alone,
/// which of them misleads, the probabilities stacked in the order of `Phase`, and what they add up
/// to for each wheel. Files as `draw_figure`; the data are `<stem>_<n>.dat`, as intervals
/// `<stem>_truth_<n>.dat` and, as a matrix, `<stem>_likelihood_<n>.dat`. Errors: as `draw_figure`.
Figure draw_phase_posterior(const std::vector<experiments::DropPosterior>& drops,
                            const FigureText& text, const std::filesystem::path& stem);

}  // namespace touchdown::render
