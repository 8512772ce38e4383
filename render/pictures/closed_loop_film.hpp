#pragma once

#include <atomic>

#include "experiments/tables/result.hpp"

namespace touchdown::render {

/// Films the run that `closed_loop.film` names, in every engine, as
/// `videos/closed_loop_<engine>.mp4`: started alike, told about contact by up to four, side by
/// side, with what each was told below. The runs are played again for it. Errors: as
/// `render_video`; `Stopped`.
void film_closed_loop(const experiments::ExperimentResult& result, const std::atomic<bool>* stop);

}  // namespace touchdown::render
