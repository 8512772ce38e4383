#pragma once

#include <string>

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// A sentence about each of the experiment's estimators: what it does, what it listens to.
ReportSection estimators_section(const ReportSubject& subject);

/// A paragraph per engine: who errs least at the highlighted noise settings, and how much the
/// others do. Nothing without scores.
std::string findings_html(const ReportSubject& subject);

}  // namespace touchdown::render
