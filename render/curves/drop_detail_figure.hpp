#pragma once

#include <filesystem>
#include <string>

#include "experiments/drops/detail.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws one drop through its noise settings, one column each: height, true and noisy torques,
/// contact probabilities, spectrograms with power and median frequency, transition probabilities;
/// everywhere over the time in which the left wheel truly touches. Files as `draw_figure`; the data
/// are `<stem>_<n>.dat` per setting and, as `spectrum_text`, `<stem>_spectrum_<n>.dat`, number 0
/// being noiseless. Errors: as `draw_figure`.
Figure draw_drop_detail(const experiments::DropDetail& detail, const FigureText& text,
                        const std::filesystem::path& stem);

/// A spectrogram as a matrix for gnuplot: a row per eighth of an octave, each the frequency bin
/// that is nearest to it; a column per `spectrum_stride`-th step; in dB of m²/s⁴.
std::string spectrum_text(const experiments::SpectrumTrace& trace, double bin_width);

}  // namespace touchdown::render
