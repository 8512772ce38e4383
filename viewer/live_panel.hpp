#pragma once

#include <vector>

#include "viewer/live_controls.hpp"
#include "viewer/screen/panel.hpp"
#include "viewer/screen/screen.hpp"

namespace touchdown::viewer {

/// The labels over the scene of a live run.
std::vector<Chip> live_chips(const LiveControls& controls, const LiveState& state);

/// The lines of the panel beside it. The number of a slider is a `LiveNumber`.
std::vector<PanelLine> live_panel(const LiveControls& controls, const LiveState& state);

}  // namespace touchdown::viewer
