#pragma once

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// The figures of the run directory, with what their scripts say about them.
ReportSection figures_section(const ReportSubject& subject);

}  // namespace touchdown::render
