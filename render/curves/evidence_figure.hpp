#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "estimator/evidence/curves.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The curves of a fitted additive model: the evidence of each channel for or against contact, at
/// each time scale, and that of the noise levels. Each has a panel; all panels span the same range
/// of nats. Curves end where the training data end.
struct EvidenceFigure {
  std::string title;
  EvidenceModel model;
  std::string caption;
};

/// A tick of an axis that is compressed like a channel's input.
struct CompressedTick {
  double value = 0.0;
  double place = 0.0;  ///< position on the compressed axis
};

/// Round values between both ends of a compressed axis: 0, and 1 or 3 times powers of ten of either
/// sign. Rounder values take precedence, so that labels do not touch. A `softsign_scale` of 0 means
/// a logarithmic axis.
std::vector<CompressedTick> compressed_ticks(double low, double high, double softsign_scale);

/// Draws an evidence figure. Files as `draw_figure`. Errors: `Error` as `draw_figure`.
Figure draw_evidence_figure(const EvidenceFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown::render
