#pragma once

#include "experiments/run_experiment.hpp"
#include "render/video.hpp"

namespace touchdown {

/// What an estimator says along a noisy recording, for a video. `noise` was drawn for the run.
BeliefTrack believe(const Condition& condition, const FittedModels& models, const HeardRun& run,
                    const UnitNoise& noise, const NoiseLevels& levels);

/// The recording as its sensors with this noise report it; the ground truth stays.
Recording with_noise(Recording recording, const NoiseKey& key, const NoiseLevels& levels);

/// The robot on the terrain of the scenario that a recording says it was made in.
/// Errors: `InputError` for a recording that does not say.
RobotModel robot_of(const Recording& recording);

}  // namespace touchdown
