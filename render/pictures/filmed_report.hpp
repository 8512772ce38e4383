#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "render/pictures/filmed_run.hpp"
#include "render/pictures/study_pictures.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Writes `report.html` into a run directory, and the pages of its studies. If there are filmed
/// runs, the report contains a small film with up to two of them side by side. Returns the report's
/// path.
std::filesystem::path make_report(const ReportSubject& subject,
                                  const std::vector<FilmedRun>& filmed,
                                  const std::vector<StudyPictures>& studies,
                                  const std::atomic<bool>* stop);

}  // namespace touchdown::render
