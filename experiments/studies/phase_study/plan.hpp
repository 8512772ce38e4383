#pragma once

#include <array>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// Estimators that are compared in every scene.
inline constexpr std::array<const char*, 3> compared_estimators = {"phase", "robust", "nmn"};

/// Scenes besides the experiment's own, where the robot is hung up, lifted, or only drives about.
inline constexpr std::array<const char*, 3> more_scenes = {"hang", "lift", "roam"};

/// So many runs of the first scene of `fit.pieces` the learning curve fits.
inline constexpr std::array<int, 4> learning_curve = {3, 6, 12, 48};

/// The fit that takes so many, as conditions name it.
std::string segments_fit(int segments);

/// What the phase filter's study (docs/protocol.md) adds to an experiment's plan: more runs to cut
/// pieces from; listeners that were fitted in the other engine or to more or fewer pieces; noise on
/// knees and wheels apart, disturbances, and more scenes.
void add_phase_study(const RunRequest& request, Plan& plan);

}  // namespace touchdown::experiments
