#pragma once

#include <filesystem>
#include <string>

#include "experiments/drops/detail.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws one drop through its noise settings, one column each: height, true and noisy torques,
/// contact probabilities, spectrograms with power and median frequency, transition probabilities;
/// everywhere over the time in which the left wheel truly touches. Files as `draw_figure`; the data
/// are `<stem>_<n>.dat` per setting and `<stem>_spectrum_<n>.dat`, number 0 being noiseless (a row
/// per frequency bin, a column per `spectrum_stride`-th step, in dB).
/// Errors: as `draw_figure`.
Figure draw_drop_detail(const experiments::DropDetail& detail, const FigureText& text,
                        const std::filesystem::path& stem);

}  // namespace touchdown::render
