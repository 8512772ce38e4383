#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

/// The runs of a group in one of the experiment's scenes.
std::vector<std::size_t> runs_in_scene(const Plan& plan, const Experiment& experiment,
                                       std::size_t group, std::size_t scene);

/// The collected results of a group, by scene.
std::vector<CollectedCounts> counts_by_scene(const Evaluation& evaluation, std::size_t group);

/// The counts of each run in one cell, both wheels added: of the condition, then of its refits,
/// each in the same runs. Empty for a condition that is not scored.
std::vector<std::vector<scoring::Classification>> points_by_fit(const CollectedCounts& counts,
                                                                Condition condition,
                                                                std::size_t cell);

/// A unique number for every scene and engine, for draws of their own.
std::uint64_t stream_of(std::size_t scene, const std::string& simulator,
                        const Experiment& experiment);

}  // namespace touchdown::experiments
