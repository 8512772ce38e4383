#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/results/result.hpp"
#include "render/report/filmed_run.hpp"
#include "render/report/study_pictures.hpp"

namespace touchdown::render {

/// Draws all figures and, if `with_films`, all films of an experiment's result, those of its
/// studies included, into its run directory, and adds the elapsed time to the provenance. `stop`,
/// which may be null, is looked at between figures and frames. Errors: `Stopped`; as `draw_figure`
/// and `render_video`.
void draw_pictures(experiments::ExperimentResult& result, const std::vector<FilmedRun>& filmed,
                   const std::vector<StudyPictures>& studies, bool with_films,
                   const std::atomic<bool>* stop);

}  // namespace touchdown::render
