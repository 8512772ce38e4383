#include <algorithm>
#include <chrono>
#include <cmath>
#include <system_error>

#include "core/files.hpp"
#include "core/progress.hpp"
#include "experiments/run_directory/directory.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/film/video.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/report/report.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

/// Films some of the runs beside each other.
void film(const std::vector<VideoSource>& sources, VideoOptions options, const FilmedRun& first,
          int workers, const fs::path& path, const std::atomic<bool>* stop) {
  options.labels = first.labels;
  options.workers = workers;
  options.progress = film_progress("filming " + path.stem().string(), stop);
  render_video(sources, options, path);
}

/// Films each run in full size, into the run directory's `videos`.
void film_runs(const std::vector<FilmedRun>& runs, const experiments::Experiment& experiment,
               const fs::path& run_directory, const std::atomic<bool>* stop) {
  for (const FilmedRun& run : runs) {
    const logs::RecordingInfo& info = run.recording.info;
    const fs::path name = experiments::video_name(info.simulator, info.scenario);
    film({run.source()}, film_of_width(experiment.video.width), run, experiment.workers,
         experiments::record_file(run_directory, fs::path("videos") / name), stop);
  }
}

fs::file_time_type newest_in(const fs::path& folder) {
  fs::file_time_type newest = fs::file_time_type::min();
  std::error_code ignored;
  for (const fs::path& entry : entries_in(folder)) {
    newest = std::max(newest, fs::last_write_time(entry, ignored));
  }
  return newest;
}

/// Whether a film shows the run's present recordings and models.
bool is_current(const fs::path& file, const fs::path& run_directory) {
  std::error_code error;
  const fs::file_time_type written = fs::last_write_time(file, error);
  return !error && written > newest_in(run_directory / "recordings") &&
         written > newest_in(run_directory / "models");
}

}  // namespace

ReportFilm report_film(const fs::path& run_directory) {
  return {run_directory / "videos" / "report.mp4", run_directory / "videos" / "report.jpg"};
}

void film_for_report(const std::vector<FilmedRun>& runs, const experiments::Experiment& experiment,
                     const fs::path& run_directory, const std::atomic<bool>* stop) {
  const ReportFilm files = report_film(run_directory);
  if (runs.empty()) return;
  if (is_current(files.video, run_directory) && is_current(files.picture, run_directory)) return;
  std::vector<VideoSource> shown;
  for (const FilmedRun& run : runs) {
    if (shown.size() < 2) shown.push_back(run.source());
  }
  VideoOptions small = film_of_width(0.75 * experiment.video.width);
  small.crf = 28;
  small.fps = 20;
  small.to = longest_report_film;
  for (const char* const name : {"videos/report.mp4", "videos/report.jpg"}) {
    experiments::record_file(run_directory, name);
  }
  film(shown, small, runs.front(), experiment.workers, files.video, stop);
  small.labels = runs.front().labels;
  render_poster(shown, small, NAN, files.picture);
}

void draw_pictures(experiments::ExperimentResult& result, const std::vector<FilmedRun>& filmed,
                   const std::vector<StudyPictures>& studies, bool with_films,
                   const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("drawing", "kinds of figures", 3);
    if (result.cells.size() > 1) draw_heatmaps(result, stop);
    progress.advance();
    draw_densities(result, stop);
    draw_scores(result, stop);
    progress.advance();
    draw_drop_details(result, stop);
    for (const StudyPictures& study : studies) {
      stop_if_asked(stop);
      if (study.draw && study.is_requested(result.experiment)) study.draw(result);
    }
    for (const experiments::FigureSpec& figure : result.figures) {
      stop_if_asked(stop);
      draw_facets(figure, result.directory.read_table(figure.table),
                  figure_file(result, figure.name));
    }
    progress.advance();
  }
  if (with_films) {
    for (const StudyPictures& study : studies) {
      if (study.film && study.is_requested(result.experiment)) study.film(result, stop);
    }
    film_runs(filmed, result.experiment, result.directory.path(), stop);
    std::error_code ignored;
    fs::remove(report_film(result.directory.path()).video, ignored);
    film_for_report(filmed, result.experiment, result.directory.path(), stop);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result.provenance.timings.emplace_back("draw", elapsed.count());
}

}  // namespace touchdown::render
