#include "render/pictures/pictures.hpp"

#include <chrono>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/progress.hpp"
#include "render/figures/facets.hpp"
#include "render/film/video.hpp"
#include "render/pictures/drop_figures.hpp"
#include "render/pictures/heatmaps.hpp"
#include "render/pictures/score_figures.hpp"
#include "render/pictures/stop.hpp"

namespace touchdown::render {

namespace {

void film(const experiments::ExperimentResult& result, const FilmedRun& run,
          const std::atomic<bool>* stop) {
  const recordings::RecordingInfo& info = run.recording.info;
  VideoOptions options;
  options.labels = run.labels;
  options.workers = result.experiment.workers;
  options.progress = film_progress(fmt::format("filming {}", info.simulator), stop);
  render_video(
      {run.source()}, options,
      result.directory.file("videos", experiments::video_name(info.simulator, info.scenario)));
}

}  // namespace

void draw_pictures(experiments::ExperimentResult& result, const std::vector<FilmedRun>& filmed,
                   const std::vector<StudyPictures>& studies, const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("drawing", "kinds of figures", 3);
    if (result.cells.size() > 1) draw_heatmaps(result, stop);
    progress.advance();
    draw_score_figures(result, stop);
    progress.advance();
    draw_drop_figures(result, stop);
    for (const StudyPictures& study : studies) {
      stop_if_asked(stop);
      if (study.draw && study.is_requested(result.experiment)) study.draw(result);
    }
    for (const experiments::FigureSpec& figure : result.figures) {
      stop_if_asked(stop);
      draw_facets(figure, from_csv(read_file(result.directory.file("tables", figure.table))),
                  result.directory.file("figures", figure.name));
    }
    progress.advance();
  }
  for (const StudyPictures& study : studies) {
    if (study.film && study.is_requested(result.experiment)) study.film(result, stop);
  }
  for (const FilmedRun& run : filmed) film(result, run, stop);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result.provenance.timings.emplace_back("draw", elapsed.count());
}

}  // namespace touchdown::render
