#pragma once

#include <vector>

#include "render/film/request.hpp"
#include "render/strip/plots.hpp"

namespace touchdown::render {

/// The plots of the strip: of one run, of two beside each other, or what is believed in each of
/// more.
std::vector<StripRow> strip_rows(const std::vector<VideoSource>& sources,
                                 const scoring::LabelConfig& labels);

}  // namespace touchdown::render
