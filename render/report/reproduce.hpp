#pragma once

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// The command, versions, seeds and configuration that lead to the same numbers again.
ReportSection reproduce_section(const ReportSubject& subject);

}  // namespace touchdown::render
