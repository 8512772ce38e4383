#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "experiments/plan/condition.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

/// A test run with one noise realisation.
struct MeasuredRun {
  const RunSignals& signals;
  const NoiseRun& noise;
  int seed = 0;                         ///< number of the noise realisation
  std::vector<noise::NoiseCell> cells;  ///< the noise settings in which predictions are made
  const scoring::ScoringConfig& scoring;
};

/// The prediction of one condition for a test run in one noise setting.
struct MeasuredPrediction {
  const MeasuredRun& run;
  const Condition& condition;
  std::size_t cell = 0;  ///< index in the run's cells
  const scoring::Prediction& prediction;
};

/// Scores of one type in their memory layout, one after the other. Only the same build reads them.
template <typename Score>
std::string to_bytes(const std::vector<Score>& scores) {
  static_assert(std::is_trivially_copyable_v<Score>);
  return {reinterpret_cast<const char*>(scores.data()), scores.size() * sizeof(Score)};
}
template <typename Score>
std::vector<Score> from_bytes(const std::string& bytes) {
  static_assert(std::is_trivially_copyable_v<Score>);
  std::vector<Score> scores(bytes.size() / sizeof(Score));
  if (!scores.empty()) std::memcpy(scores.data(), bytes.data(), scores.size() * sizeof(Score));
  return scores;
}

/// What the tasks of a group of runs measure in addition to the scores of every experiment. A study
/// adds measures to its groups and reads their scores by name.
struct Measure {
  std::string name;  ///< unique in a group

  /// Scores of the run itself, and of each prediction, as `to_bytes` writes them. An empty function
  /// or an empty text: nothing is measured there.
  std::function<std::string(const MeasuredRun&)> of_run = {};
  std::function<std::string(const MeasuredPrediction&)> of_prediction = {};

  /// The most bytes that these write (for the estimate of disk space).
  std::size_t bytes_of_run = 0;
  std::size_t bytes_of_prediction = 0;
};

/// A measure of predictions with scores of one type, in a fixed order.
template <typename Score>
Measure measure_of_predictions(
    std::string name, std::size_t most,
    std::function<std::vector<Score>(const MeasuredPrediction&)> of_prediction) {
  return {std::move(name),
          {},
          [of_prediction = std::move(of_prediction)](const MeasuredPrediction& prediction) {
            return to_bytes(of_prediction(prediction));
          },
          0,
          most * sizeof(Score)};
}

}  // namespace touchdown::experiments
