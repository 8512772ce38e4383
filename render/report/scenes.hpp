#pragma once

#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Estimators scene by scene, from the run directory's `tables/benchmark.csv`: first their means on
/// every robot with its sensors, then a table for each of them, engine by engine, with the best of
/// every scene marked. Columns can be sorted by.
ReportSection scenes_section(const ReportSubject& subject);

}  // namespace touchdown::render
