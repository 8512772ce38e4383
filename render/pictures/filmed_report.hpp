#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "render/pictures/filmed_run.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Writes `report.html` into a run directory, with a small film of the runs, two of them beside
/// each other, if there are any. Returns the report.
std::filesystem::path make_report(const ReportSubject& subject,
                                  const std::vector<FilmedRun>& filmed,
                                  const std::atomic<bool>* stop);

/// The same of the run that the directory's experiment films, if it films any and `with_film`.
/// Errors: also `InputError` when it is no run directory of a finished experiment.
std::filesystem::path make_report(const std::filesystem::path& run_directory, bool with_film,
                                  const std::atomic<bool>* stop);

}  // namespace touchdown::render
