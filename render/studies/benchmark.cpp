#include "render/studies/benchmark.hpp"

#include "experiments/studies/benchmark/config.hpp"
#include "render/benchmark/page.hpp"
#include "render/benchmark/standings_figure.hpp"
#include "render/studies/worst_segments.hpp"

namespace touchdown::render {

using experiments::BenchmarkConfig;

StudyPictures benchmark_pictures() {
  const auto draw = [](const experiments::ExperimentResult& result) {
    draw_standings_figures(result.directory.path(), result.experiment.intervals.bootstrap.level);
  };
  const auto film = [](const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
    if (result.experiment.studies.at<BenchmarkConfig>().clips) film_worst_segments(result, stop);
  };
  const auto section = [](const ReportSubject& subject) {
    write_benchmark_page(subject);
    return ReportSection{
        "scenes", "Scene by scene",
        "<p><a href=\"benchmark.html\">Which estimator works where?</a> The benchmark's page shows "
        "every scene, for every robot with its sensors.</p>\n"};
  };
  return {.is_requested =
              [](const experiments::Experiment& experiment) {
                return experiment.studies.has<BenchmarkConfig>();
              },
          .draw = draw,
          .film = film,
          .section = section};
}

}  // namespace touchdown::render
