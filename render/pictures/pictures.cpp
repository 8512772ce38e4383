#include "render/pictures/pictures.hpp"

#include <chrono>

#include <fmt/format.h>

#include "render/film/video.hpp"
#include "render/pictures/drop_figures.hpp"
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
  options.progress = film_progress(fmt::format("filming {}", info.simulator), stop);
  render_video({run.source()}, options, path);
  return {"video", {path}};
}

}  // namespace

std::vector<Picture> draw_pictures(experiments::ExperimentResult& result,
                                   const std::vector<FilmedRun>& filmed,
                                   const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Picture> pictures;
  const auto add = [&](const char* kind, const Figure& figure) {
    pictures.push_back({kind, {figure.png, figure.svg}});
  };
  if (result.cells.size() > 1) {
    for (const Figure& drawn : draw_heatmaps(result)) add("heatmap", drawn);
  }
  for (const Figure& drawn : draw_score_figures(result)) add("figure", drawn);
  for (const Figure& drawn : draw_drop_figures(result)) add("figure", drawn);
  for (const FilmedRun& run : filmed) pictures.push_back(film(result, run, stop));
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  result.provenance.timings.emplace_back("draw", elapsed.count());
  return pictures;
}

}  // namespace touchdown::render
