#include <algorithm>
#include <chrono>
#include <system_error>

#include "core/files.hpp"
#include "core/progress.hpp"
#include "experiments/run_directory/directory.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/film/painter.hpp"
#include "render/film/video.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/report/report.hpp"

namespace touchdown::render {

namespace {

namespace fs = std::filesystem;

VideoOptions full_size(const FilmedRun& run) {
  VideoOptions options;
  options.labels = run.labels;
  return options;
}

double end_of(const FilmedRun& run) {
  return static_cast<double>(run.recording.steps()) * run.recording.period();
}

Film small_film(const std::vector<FilmedRun>& runs, const fs::path& run_directory) {
  Film film{.runs = {0}, .options = full_size(runs.front())};
  if (runs.size() > 1) film.runs.push_back(1);
  film.options.width = 960;
  film.options.height = 540;
  film.options.crf = 28;
  double end = 0.0;
  for (const FilmedRun& run : runs) end = std::max(end, end_of(run));
  film.options.to = std::min(end, longest_report_film);
  const ReportFilm files = report_film(run_directory);
  film.path = files.video;
  film.still = Still{files.picture, first_flight(runs.front().recording, runs.front().labels)};
  return film;
}

void paint(const std::vector<FilmedRun>& runs, std::vector<Film> films, int workers,
           const std::string& what, const std::atomic<bool>* stop) {
  std::vector<VideoSource> sources;
  for (const FilmedRun& run : runs) sources.push_back(run.source());
  films.front().options.workers = workers;
  films.front().options.progress = film_progress(what, stop);
  render_films(sources, films);
}

fs::file_time_type newest_in(const fs::path& folder) {
  fs::file_time_type newest = fs::file_time_type::min();
  std::error_code ignored;
  for (const fs::path& entry : entries_in(folder)) {
    newest = std::max(newest, fs::last_write_time(entry, ignored));
  }
  return newest;
}

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

void film_runs(const std::vector<FilmedRun>& runs, const fs::path& run_directory, int workers,
               const std::atomic<bool>* stop) {
  if (runs.empty()) return;
  std::vector<Film> films;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const logs::RecordingInfo& info = runs[i].recording.info;
    films.push_back({.runs = {i},
                     .options = full_size(runs[i]),
                     .path = experiments::record_file(
                         run_directory, fs::path("videos") / experiments::video_name(
                                                                 info.simulator, info.scenario))});
  }
  films.push_back(small_film(runs, run_directory));
  paint(runs, std::move(films), workers, "filming", stop);
}

void film_for_report(const std::vector<FilmedRun>& runs, const fs::path& run_directory, int workers,
                     const std::atomic<bool>* stop) {
  if (runs.empty()) return;
  const ReportFilm files = report_film(run_directory);
  if (is_current(files.video, run_directory) && is_current(files.picture, run_directory)) return;
  Film film = small_film(runs, run_directory);
  film.least_view = single_view_size(full_size(runs.front()));
  paint(runs, {std::move(film)}, workers, "filming for the report", stop);
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
    draw_evidence(result, stop);
    draw_scores(result, stop);
    progress.advance();
    draw_drop_details(result, stop);
    draw_phase_posteriors(result, stop);
    for (const StudyPictures& study : studies) {
      stop_if_asked(stop);
      if (study.draw && study.is_requested(result.experiment)) study.draw(result);
    }
    for (const experiments::FigureSpec& figure : result.figures) {
      stop_if_asked(stop);
      draw_facets(figure, result.directory.read_table(figure.table),
                  result.directory.file("figures", figure.name));
    }
    progress.advance();
  }
  for (const StudyPictures& study : studies) {
    if (!with_films) break;
    if (study.film && study.is_requested(result.experiment)) study.film(result, stop);
  }
  if (with_films) {
    film_runs(filmed, result.directory.path(), result.experiment.workers, stop);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result.provenance.timings.emplace_back("draw", elapsed.count());
}

}  // namespace touchdown::render
