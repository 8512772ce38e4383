#pragma once

#include <string>

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// The title, one sentence, and the numbers of engines, runs, flights and noise settings.
std::string header_html(const ReportSubject& subject);

/// The results at the highlighted noise settings, in words and as tables of accuracies.
ReportSection results_section(const ReportSubject& subject);

/// The paper's tables at the highlighted noise settings, with the paper's numbers beside ours.
ReportSection paper_section(const ReportSubject& subject);

}  // namespace touchdown::render
