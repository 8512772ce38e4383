#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/plan/request.hpp"  // `setup_caption`, for captions too
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

struct ExperimentResult;

/// "1 run", "2 runs".
std::string plural(std::size_t count, const std::string& thing);
/// The definition of contact: "contact: normal force > 1 N, states under 5 ms merged".
std::string labels_text(const Experiment& experiment);
/// The statistical sample of the intervals: "run", "drop".
std::string sample_text(const Experiment& experiment);
/// "95 % bootstrap intervals over runs".
std::string intervals_text(const Experiment& experiment);
/// How hyperparameters were tuned, or the values from the file: a sentence with a space before it;
/// empty for the defaults.
std::string tuning_text(const Experiment& experiment);
/// The conditions of all scores of both wheels: labels, skipped time, intervals, tuning.
std::string conditions_text(const Experiment& experiment);
/// "torque noise 1 N·m, accelerometer noise 5 m/s²".
std::string noise_text(const noise::NoiseCell& cell);
/// The estimator of this name, external or built-in; null for another name.
const EstimatorEntry* find_estimator(std::string_view name,
                                     std::span<const EstimatorEntry> external = {});
/// "Bayes filter (robust)"; the name itself for an estimator without a title.
std::string estimator_title(const std::string& estimator,
                            std::span<const EstimatorEntry> external = {});
/// The same for an experiment's own estimators, too, such as those written in Python.
std::string estimator_title_in(const Experiment& experiment, const std::string& estimator);
/// The same as a function, for the groups of a figure, which `experiment` must outlive.
std::function<std::string(const std::string&)> titles_in(const Experiment& experiment);
/// Whether the estimator is fitted to a scene of the test, which is an advantage.
bool is_fitted_to_test(const Experiment& experiment, const std::string& estimator);
/// What a reader of the scores has to know: a test without a flight, estimators that are fitted to
/// its scenes, fitted ones that report hardly any flight in a highlighted cell, with the likely
/// cause. Empty without any.
std::string score_notes(const Experiment& experiment, const ScoreTables& tables);
/// The test runs of one engine.
struct TestRuns {
  std::size_t scored = 0;  ///< that did not fail
  std::size_t all = 0;
};
TestRuns test_runs(const ExperimentResult& result, const std::string& simulator);
/// "40 test runs", "38 of 40 test runs".
std::string text_of(const TestRuns& runs);

/// The data of one engine's scores: "40 test runs × 1 noise seed; contact: ...".
std::string scored_text(const ExperimentResult& result, const std::string& simulator);

}  // namespace touchdown::experiments
