#pragma once

#include <filesystem>
#include <string>

#include "logs/recording.hpp"
#include "render/gnuplot/figure.hpp"
#include "scoring/labels.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::render {

/// The drop of a run that is drawn, and the definition of flights.
struct DropOverlay {
  int drop = 0;                      ///< of each run, from 0; a drop is a flight of both wheels
  scoring::LabelConfig labels = {};  ///< what counts as contact
  double minimum_flight = 0.05;      ///< shorter flights are no drops (s)
  std::string title;
  std::string caption;  ///< the runs, and what counts as contact
};

/// Draws one drop as simulated in both engines, aligned at takeoff: height of the base, normal
/// force, knee and wheel torque of the left leg, vertical acceleration. Files as `draw_figure`.
/// Errors: `InputError` when a run has no such drop; `Error` as `draw_figure`.
Figure draw_drop_overlay(const logs::Recording& first, const logs::Recording& second,
                         const DropOverlay& what, const std::filesystem::path& stem);

}  // namespace touchdown::render
