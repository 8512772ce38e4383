#pragma once

#include <string>

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Title, one sentence, and the numbers that say how much was done.
std::string header_html(const ReportSubject& subject);

/// Success rates at the highlighted noise settings.
ReportSection results_section(const ReportSubject& subject);

/// The paper's tables at the highlighted noise settings, with the paper's numbers beside ours.
ReportSection paper_section(const ReportSubject& subject);

}  // namespace touchdown::render
