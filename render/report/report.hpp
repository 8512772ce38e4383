#pragma once

#include <filesystem>
#include <vector>

#include "render/report/filmed_run.hpp"
#include "render/report/study_pictures.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// What a report shows of runs and films.
struct ReportParts {
  bool film = true;    ///< films that are in the run directory
  bool replay = true;  ///< a replay that the reader can turn
};

/// Writes `report.html` into a run directory, and the pages of its studies: one file that opens
/// without a network. It contains the directory's `manifest.json`, `config.yaml`, `tables/` and
/// `figures/`; film and replay show the filmed runs. Missing parts are left out. Returns the
/// report's path. Errors: `InputError` when one of these files is broken; `Error` when the report
/// cannot be written.
std::filesystem::path make_report(const ReportSubject& subject,
                                  const std::vector<FilmedRun>& filmed,
                                  const std::vector<StudyPictures>& studies,
                                  const ReportParts& parts = {});

}  // namespace touchdown::render
