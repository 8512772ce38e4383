#pragma once

#include <string>

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// A summary of each of the experiment's estimators, and its input signals.
ReportSection estimators_section(const ReportSubject& subject);

/// A paragraph per engine: the estimator with the lowest error rate at each highlighted noise
/// setting, and the error rates of the next two. Empty without scores.
std::string findings_html(const ReportSubject& subject);

}  // namespace touchdown::render
