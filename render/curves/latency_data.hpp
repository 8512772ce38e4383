#pragma once

#include <array>
#include <string>
#include <vector>

#include "scoring/transitions.hpp"

namespace touchdown::render {

/// One estimator's transitions.
struct LatencyRow {
  std::string name;
  scoring::TransitionCounts takeoff, landing;
};

struct LatencyPanel {
  std::string title;
  std::vector<LatencyRow> rows;
};

/// How latencies of takeoffs and landings are distributed: a histogram per estimator, one pair of
/// panels per noise setting. Early is negative.
struct LatencyFigure {
  std::string title;
  std::vector<LatencyPanel> panels;
  std::string caption;
};

struct LatencyKind {
  const char* name;
  scoring::TransitionCounts LatencyRow::*counts;
};
inline constexpr std::array<LatencyKind, 2> latency_kinds = {
    {{"takeoff", &LatencyRow::takeoff}, {"landing", &LatencyRow::landing}}};

/// A latency figure's data file: blocks (gnuplot's `index`) by panel, kind and estimator with the
/// histogram's outline (latency in ms, foot, top); then one per panel and kind with a row per
/// estimator: its mean, its foot, and what is written beside it.
std::string latency_data(const LatencyFigure& figure);

}  // namespace touchdown::render
