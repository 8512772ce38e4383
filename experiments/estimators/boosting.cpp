#include "experiments/estimators/boosting.hpp"

#include "experiments/boosting/estimator.hpp"
#include "experiments/boosting/fit.hpp"
#include "experiments/estimators/parameter_fitting.hpp"

namespace touchdown::experiments {

namespace {

using EstimatorPointer = std::unique_ptr<ContactEstimator>;
using TreesConfig = BoostedTreesEstimator::Config;
using recordings::parameter;
using recordings::Parameters;

Parameters parameters_of(const BoostedTrees& trees) {
  const auto numbers = [](const auto& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  return {
      {"depth", {static_cast<double>(trees.depth)}},   {"bias", {static_cast<double>(trees.bias)}},
      {"trees", {static_cast<double>(trees.trees())}}, {"feature", numbers(trees.feature)},
      {"threshold", numbers(trees.threshold)},         {"leaf", numbers(trees.leaf)}};
}

/// The inverse of `parameters_of`. It converts doubles that were floats back to floats.
BoostedTrees trees_of(const Parameters& parameters) {
  const auto whole = [&](const char* name, double largest) {
    const double value = parameter(parameters, name);
    return static_cast<std::size_t>(value >= 0.0 && value <= largest ? value : 0.0);
  };
  constexpr double most_trees = 1e6;
  constexpr double deepest = 16.0;
  BoostedTrees trees{.depth = whole("depth", deepest),
                     .bias = static_cast<float>(parameter(parameters, "bias"))};
  const std::size_t count = whole("trees", most_trees);
  for (const double value : parameter(parameters, "feature", count * trees.nodes())) {
    trees.feature.push_back(value >= 0.0 && value < static_cast<double>(window_features)
                                ? static_cast<std::uint8_t>(value)
                                : std::uint8_t{window_features});
  }
  for (const double value : parameter(parameters, "threshold", count * trees.nodes())) {
    trees.threshold.push_back(static_cast<float>(value));
  }
  for (const double value : parameter(parameters, "leaf", count * trees.leaves())) {
    trees.leaf.push_back(static_cast<float>(value));
  }
  return trees;
}

FittedModel fit_boosted_trees(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs.together(), [&](std::span<const LabelledRun> labelled) {
    BoostingConfig config;
    config.trees = static_cast<std::size_t>(entry.chosen("trees"));
    config.depth = static_cast<std::size_t>(entry.chosen("depth"));
    return parameters_of(fit_trees(boosting_rows(labelled, config), config, runs.before_density));
  });
}

}  // namespace

EstimatorEntry gradient_boosting_entry() {
  return {.name = "gradient_boosting",
          .title = "Gradient boosting",
          .summary =
              "Classifies 100 ms of the phase filter's signals by boosted trees, as an upper bound",
          .sensors = {.knee_torque = true, .wheel_torque = true, .acceleration = true},
          .is_upper_bound = true,
          .fit = fit_boosted_trees,
          .learns_from_segments = true,
          .hyperparameters = {fitted_with(whole_between("trees", BoostingConfig{}.trees, 40, 240)),
                              fitted_with(whole_between("depth", BoostingConfig{}.depth, 3, 8)),
                              between("leave_below", TreesConfig{}.leave_below, 0.25, 0.8),
                              between("return_above", TreesConfig{}.return_above, 0.8, 0.97)},
          .make = [](const EstimatorEntry& entry, const EstimatorSetup& setup) -> EstimatorPointer {
            return std::make_unique<BoostedTreesEstimator>(
                trees_of(setup.model->parameters->parameters),
                TreesConfig{.sample_rate = setup.sample_rate,
                            .leave_below = entry.chosen("leave_below"),
                            .return_above = entry.chosen("return_above")});
          }};
}

}  // namespace touchdown::experiments
