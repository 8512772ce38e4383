#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/plan/sensors.hpp"  // `equipment_text`, for captions too
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

struct ExperimentResult;

/// "1 run", "2 runs".
std::string plural(std::size_t count, const std::string& thing);
/// When a wheel counts as in contact: "contact: normal force > 1 N, states under 5 ms merged".
std::string labels_text(const Experiment& experiment);
/// What an interval takes as its samples: "run", "drop".
std::string sample_text(const Experiment& experiment);
/// "95 % bootstrap intervals over runs".
std::string intervals_text(const Experiment& experiment);
/// How estimators' constants were chosen, or what the file gives, a sentence with a space before
/// it; nothing where they are the defaults.
std::string tuning_text(const Experiment& experiment);
/// What all scores of both wheels have in common: labels, what is not scored, intervals, tuning.
std::string conditions_text(const Experiment& experiment);
/// "torque noise 1 N·m, accelerometer noise 5 m/s²".
std::string noise_text(const noise::NoiseCell& cell);
/// "Bayes filter (robust)"; the name itself where there is no better one.
std::string estimator_title(const std::string& estimator);
/// False takeoffs per minute of what the summary is of: "0.6"; a dash where nobody counted them.
std::string false_takeoffs_text(const std::vector<ScoreSummary>& scores,
                                const CellSummary& summary);
/// What stands behind one engine's scores: "40 test runs × 1 noise seed; contact: ...".
std::string scored_text(const ExperimentResult& result, const std::string& simulator);

}  // namespace touchdown::experiments
