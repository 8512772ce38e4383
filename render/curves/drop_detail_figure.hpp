#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/results/drops.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws one drop with a column per noise setting: height, true and noisy torques, contact
/// probabilities, spectrograms with power and median frequency, transition probabilities. A tint
/// marks the true contact of the left wheel. `estimators` are all estimators of the experiment;
/// they determine the colours. Files as `draw_figure`; the data are `<stem>_<n>.dat` per setting
/// and, as `spectrum_text`, `<stem>_spectrum_<n>.dat`, number 0 being noiseless. Errors: as
/// `draw_figure`.
Figure draw_drop_detail(const experiments::DropDetail& detail,
                        const std::vector<std::string>& estimators, const FigureText& text,
                        const std::filesystem::path& stem);

/// A spectrogram as a matrix for gnuplot, in dB of m²/s⁴: a row per eighth of an octave with the
/// nearest frequency bin, and a column per `spectrum_stride`-th step.
std::string spectrum_text(const experiments::SpectrumTrace& trace, double bin_width);

}  // namespace touchdown::render
