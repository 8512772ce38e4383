#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "render/pictures/filmed_run.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Writes `report.html` into a run directory, with a small film of the runs, two of them beside
/// each other, if there are any; of a benchmark `benchmark.html` too. Returns the report.
std::filesystem::path make_report(const ReportSubject& subject,
                                  const std::vector<FilmedRun>& filmed,
                                  const std::atomic<bool>* stop);

}  // namespace touchdown::render
