#pragma once

#include <atomic>
#include <string>

#include "experiments/results/result.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// Films the run that `closed_loop.film` names, in every engine, as
/// `videos/closed_loop_<engine>.mp4`: started alike, told about contact by up to four, side by
/// side, with what each was told below, and a picture of each beside it. The runs are played again
/// for it. Errors: as `render_video`; `Stopped`.
void film_closed_loop(const experiments::ExperimentResult& result, const std::atomic<bool>* stop);

/// A picture for each of those films that are there, which leads to it; nothing without.
std::string closed_loop_films_html(const ReportSubject& subject);

}  // namespace touchdown::render
