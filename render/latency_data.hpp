#pragma once

#include <array>
#include <string>

#include "render/latency_figure.hpp"

namespace touchdown {

struct LatencyKind {
  const char* name;
  TransitionCounts LatencyRow::*counts;
};
inline constexpr std::array<LatencyKind, 2> latency_kinds = {
    {{"takeoff", &LatencyRow::takeoff}, {"landing", &LatencyRow::landing}}};

/// A latency figure's data file: blocks (gnuplot's `index`) by panel, kind and estimator with the
/// histogram's outline (latency in ms, foot, top); then one per panel and kind with a row per
/// estimator: its mean, its foot, and what is written beside it.
std::string latency_data(const LatencyFigure& figure);

}  // namespace touchdown
