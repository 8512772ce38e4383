#pragma once

#include <string>
#include <vector>

#include "experiments/drops/detail.hpp"
#include "render/gnuplot/columns.hpp"

namespace touchdown::render {

/// What is drawn of one noise setting, a line per step.
PlotColumns detail_columns(const experiments::DropDetail& detail,
                           const experiments::NoisyDrop& drop);

/// Spectra are drawn over octaves, log2 of the frequency in Hz: what tells takeoffs from landings
/// is below 30 Hz.
inline constexpr double lowest_octave = 1.0, highest_octave = 9.0;
inline constexpr double rows_per_octave = 8.0;

/// A spectrogram as a matrix for gnuplot: a row per eighth of an octave, each the frequency bin
/// that is nearest to it; a column per `spectrum_stride`-th step; in dB of m²/s⁴.
std::string spectrum_text(const experiments::SpectrumTrace& trace, double bin_width);

/// Seconds as the milliseconds of the time axis.
std::vector<double> in_ms(std::vector<double> seconds);

}  // namespace touchdown::render
