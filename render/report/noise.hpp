#pragma once

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Maps of the error rate over the study's noise grids; empty for a single noise setting.
ReportSection heatmap_section(const ReportSubject& subject);

}  // namespace touchdown::render
