#pragma once

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// The figures of the run directory, with the texts of their scripts.
ReportSection figures_section(const ReportSubject& subject);

}  // namespace touchdown::render
