#pragma once

#include "experiments/fitting/make_estimator.hpp"
#include "render/film/video.hpp"

namespace touchdown::render {

/// What an estimator says along a noisy recording, for a video. `noise` was drawn for the run.
BeliefTrack believe(const experiments::Condition& condition,
                    const experiments::FittedModels& models, const experiments::RunSignals& run,
                    const experiments::NoiseRun& noise, const noise::SensorNoise& levels);

}  // namespace touchdown::render
