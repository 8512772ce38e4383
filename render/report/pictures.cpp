#include "render/report/pictures.hpp"

#include <chrono>

#include "core/progress.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/report/films.hpp"
#include "render/stop.hpp"

namespace touchdown::render {

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
