#pragma once

#include <vector>

#include "render/film/request.hpp"
#include "render/strip/plots.hpp"

namespace touchdown::render {

/// The plots of the strip for one or two runs.
std::vector<StripRow> strip_rows(const std::vector<VideoSource>& sources,
                                 const scoring::LabelConfig& labels);

}  // namespace touchdown::render
