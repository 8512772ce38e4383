#include "experiments/studies/learning_curve/config.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {

/// The number of training segments, or without them of fitted runs.
static std::size_t training_pieces(const Experiment& experiment) {
  if (experiment.training_segments.empty()) {
    return experiment.fit.scenarios.size() * static_cast<std::size_t>(experiment.fit.runs);
  }
  std::size_t pieces = 0;
  for (const TrainingSegments& segments : experiment.training_segments) {
    pieces += static_cast<std::size_t>(segments.runs);
  }
  return pieces;
}

static void describe(Fields& fields, LearningCurveConfig& config, const Experiment& experiment) {
  const std::size_t most = training_pieces(experiment);
  const std::vector<int>& sizes = config.sizes;
  fields.know("sizes");
  fields.know("draws");
  fields.finish();
  fields.require("sizes", config.sizes)
      .range("from 1, increasing")
      .doc(
          "Sizes of the training sets: numbers of segments of `fit.segments`, from its scenes in "
          "turn; without it, of fitted runs.");
  fields.check(!sizes.empty(), "sizes", "expected at least one number");
  const bool is_increasing = std::is_sorted(sizes.begin(), sizes.end(), std::less_equal<>());
  fields.check(sizes.empty() || (sizes.front() >= 1 && is_increasing), "sizes",
               "expected increasing numbers from 1 on");
  fields.check(sizes.empty() || static_cast<std::size_t>(sizes.back()) <= most, "sizes",
               fmt::format("expected at most the number of segments or fitted runs, {}", most));
  fields("draws", config.draws, 1, 1000)
      .doc("Training sets of each size; all but the first are drawn from all segments or runs.");
}

StudySection learning_curve_section() {
  return optional_section<LearningCurveConfig>(
      "learning_curve", "Scores of every fitted estimator by the size of its training set.");
}

}  // namespace touchdown::experiments
