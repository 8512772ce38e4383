#pragma once

#include <filesystem>
#include <vector>

#include "render/pictures/filmed_run.hpp"
#include "render/pictures/study_pictures.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// What a report shows of runs and films.
struct ReportParts {
  bool film = true;    ///< films that are in the run directory
  bool replay = true;  ///< a replay that the reader can turn
};

/// Writes `report.html` into a run directory, and the pages of its studies. Film and replay show
/// the filmed runs, if there are any. Returns the report's path.
std::filesystem::path make_report(const ReportSubject& subject,
                                  const std::vector<FilmedRun>& filmed,
                                  const std::vector<StudyPictures>& studies,
                                  const ReportParts& parts = {});

}  // namespace touchdown::render
