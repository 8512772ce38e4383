#pragma once

#include <filesystem>
#include <string>

#include "render/curves/log_trace.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws a log and what an estimator made of it over time: torques, vertical acceleration, contact
/// probability, takeoff and landing probability where the estimator has them, contact as decided
/// and, where it is known, as it was, and the signals' status. Each curve fills the space between
/// its lowest and highest value. Files as `draw_figure`.
/// Errors: `InputError` for a trace without steps; `Error` as `draw_figure`.
Figure draw_log(const LogTrace& trace, const std::string& title, const std::filesystem::path& stem);

}  // namespace touchdown::render
