#pragma once

#include <array>

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// The estimators that are compared in every scene.
inline constexpr std::array<const char*, 3> compared_estimators = {"phase", "robust", "nmn"};

/// Scenes besides the experiment's own: the robot hangs, is lifted, or only drives.
inline constexpr std::array<const char*, 3> more_scenes = {"hang", "lift", "roam"};

/// Numbers of runs of the first scene of `fit.segments` in the learning curve.
inline constexpr std::array<int, 4> learning_curve = {3, 6, 12, 48};

/// The name of the fit with this number of runs, in conditions.
std::string segments_fit(int segments);

/// Adds the phase filter's study (docs/protocol.md) to an experiment's plan: more runs for training
/// segments; estimators that were fitted in the other engine or to other numbers of segments; noise
/// on knees or wheels alone, disturbances, and more scenes.
void add_phase_study(const RunRequest& request, Plan& plan);

}  // namespace touchdown::experiments
