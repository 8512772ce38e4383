#pragma once

#include <string>

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Title, one sentence, and the numbers that say how much was done.
std::string header_html(const ReportSubject& subject);

/// What came out at the highlighted noise settings, in words and as success rates.
ReportSection results_section(const ReportSubject& subject);

/// The paper's tables at the highlighted noise settings, with the paper's numbers beside ours.
ReportSection paper_section(const ReportSubject& subject);

}  // namespace touchdown::render
