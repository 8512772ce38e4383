#pragma once

#include <string>
#include <vector>

#include "render/film/request.hpp"

namespace touchdown::render {

/// A replay of simulated runs for the report: a view that the reader can turn, beside the
/// estimators' contact probabilities. `scene3d.js` and `replay.js` (render/report) draw it from the
/// data that it contains.
std::string replay_html(const std::vector<VideoSource>& runs, const scoring::LabelConfig& labels);

}  // namespace touchdown::render
