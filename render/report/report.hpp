#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/results/result.hpp"
#include "render/report/filmed_run.hpp"
#include "render/report/html.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// What is drawn of a study besides the figures of its tables. A study without such pictures needs
/// none of this; an empty function draws nothing. Each function is called for experiments that ask
/// for the study.
struct StudyPictures {
  std::function<bool(const experiments::Experiment&)> is_requested;
  /// Draws figures into the run directory.
  std::function<void(const experiments::ExperimentResult&)> draw = {};
  /// Films runs. Errors: as `render_video`; `Stopped`.
  std::function<void(const experiments::ExperimentResult&, const std::atomic<bool>* stop)> film =
      {};
  /// The HTML of its films, for the report's section of films.
  std::function<std::string(const ReportSubject&)> film_html = {};
  /// Writes pages beside the report, and returns the report's section about them.
  std::function<ReportSection(const ReportSubject&)> section = {};
};

/// Draws all figures and, if `with_films`, all films of an experiment's result, those of its
/// studies included, into its run directory, and adds the elapsed time to the provenance. `stop`,
/// which may be null, is looked at between figures and frames. Errors: `Stopped`; as `draw_figure`
/// and `render_video`.
void draw_pictures(experiments::ExperimentResult& result, const std::vector<FilmedRun>& filmed,
                   const std::vector<StudyPictures>& studies, bool with_films,
                   const std::atomic<bool>* stop);

/// Only this much of a longer run is in the report's film (s), because the page contains it.
inline constexpr double longest_report_film = 20.0;

/// The report's small film of up to two runs beside each other, and a picture of it.
struct ReportFilm {
  std::filesystem::path video, picture;
};
ReportFilm report_film(const std::filesystem::path& run_directory);

/// Writes the report's film and its picture, unless the run directory has them.
void film_for_report(const std::vector<FilmedRun>& runs, const experiments::Experiment& experiment,
                     const std::filesystem::path& run_directory, const std::atomic<bool>* stop);

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
