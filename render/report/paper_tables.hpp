#pragma once

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// The paper's tables at the highlighted noise settings, with the paper's numbers beside ours.
ReportSection paper_section(const ReportSubject& subject);

}  // namespace touchdown::render
