#pragma once

#include <vector>

#include "render/film/request.hpp"
#include "render/strip/plots.hpp"

namespace touchdown::render {

/// The plots of the strip: all of them for one run, P(contact) and knee torques for two runs, and
/// P(contact) alone for more.
std::vector<StripRow> strip_rows(const std::vector<VideoSource>& sources,
                                 const scoring::LabelConfig& labels);

}  // namespace touchdown::render
