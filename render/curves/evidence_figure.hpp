#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "estimator/evidence/curves.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The curves of a fitted model: what every channel says for contact and against it, at each of its
/// time scales, and what the noise levels say; one panel each, all of the same height in nats.
/// Curves end where their rows do.
struct EvidenceFigure {
  std::string title;
  EvidenceModel model;
  std::string caption;
};

/// A tick of an axis that is compressed as a channel with this bend is heard.
struct CompressedTick {
  double value = 0.0;
  double place = 0.0;  ///< on the compressed axis
};

/// Round values (0, and 1 or 3 times powers of ten of either sign) between both ends of a
/// compressed axis, the rounder ones first as long as labels stay apart.
std::vector<CompressedTick> compressed_ticks(double low, double high, double bend);

/// Draws an evidence figure. Files as `draw_figure`. Errors: `Error` as `draw_figure`.
Figure draw_evidence_figure(const EvidenceFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown::render
