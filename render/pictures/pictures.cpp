#include "render/pictures/pictures.hpp"

#include <chrono>

#include <fmt/format.h>

#include "render/film/video.hpp"
#include "render/maps/heatmap_figure.hpp"
#include "render/pictures/drop_figures.hpp"
#include "render/pictures/film_progress.hpp"
#include "render/pictures/heatmaps.hpp"
#include "render/pictures/score_figures.hpp"

namespace touchdown::render {

namespace {

Picture film(const experiments::ExperimentResult& result, const FilmedRun& run,
             const std::atomic<bool>* stop) {
  const recordings::RecordingInfo& info = run.recording.info;
  const auto path =
      result.directory.file("videos", experiments::video_name(info.simulator, info.scenario));
  VideoOptions options;
  options.labels = run.labels;
  options.workers = result.experiment.workers;
  options.progress = FilmProgress(fmt::format("filming {}", info.simulator), stop);
  render_video({run.source()}, options, path);
  return {"video", {path}};
}

}  // namespace

std::vector<Picture> draw_pictures(experiments::ExperimentResult& result,
                                   const std::vector<FilmedRun>& filmed,
                                   const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Picture> pictures;
  const auto draw = [&](const Heatmap& map, const std::string& name) {
    pictures.push_back(
        picture("heatmap", draw_heatmap(map, result.directory.file("figures", name))));
  };
  if (result.cells.size() > 1) {
    for (const std::string& simulator : result.experiment.simulators) {
      draw(success_heatmap(result, simulator), "success_" + simulator);
      if (const auto map = knee_wheel_heatmap(result, simulator)) {
        draw(*map, "knee_wheel_" + simulator);
      }
    }
  }
  for (Picture& drawn : draw_score_figures(result)) pictures.push_back(std::move(drawn));
  for (Picture& drawn : draw_drop_figures(result)) pictures.push_back(std::move(drawn));
  for (const FilmedRun& run : filmed) pictures.push_back(film(result, run, stop));
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result.provenance.timings.emplace_back("draw", elapsed.count());
  return pictures;
}

}  // namespace touchdown::render
