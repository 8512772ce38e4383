#pragma once

#include <atomic>
#include <string>

#include "experiments/results/result.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Films the run that `closed_loop.film` names, in every engine, as
/// `videos/closed_loop_<engine>.mp4` with a still picture beside it. Up to four contact sources
/// start from the same conditions and are shown side by side, with their contact probabilities
/// below. The runs are simulated again for the film. Errors: as `render_video`; `Stopped`.
void film_closed_loop(const experiments::ExperimentResult& result, const std::atomic<bool>* stop);

/// A still picture with a link for each of these films in the run directory; empty without films.
std::string closed_loop_films_html(const ReportSubject& subject);

}  // namespace touchdown::render
