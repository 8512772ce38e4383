#include <cstdint>
#include <memory>
#include <vector>

#include "estimator/decision/config.hpp"
#include "estimator/models/parameters.hpp"
#include "experiments/boosting/estimator.hpp"
#include "experiments/boosting/fit.hpp"
#include "experiments/boosting/inputs.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/fits.hpp"

namespace touchdown::experiments {

namespace {

Parameters parameters_of(const BoostedTrees& trees) {
  const auto numbers = [](const auto& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  return {
      {"depth", {static_cast<double>(trees.depth)}},   {"bias", {static_cast<double>(trees.bias)}},
      {"trees", {static_cast<double>(trees.trees())}}, {"feature", numbers(trees.feature)},
      {"threshold", numbers(trees.threshold)},         {"leaf", numbers(trees.leaf)}};
}

static_assert(SignalWindow::count < 256 && ChannelInputs::count < 256, "features are bytes");

/// The inverse of `parameters_of`. It converts doubles that were floats back to floats.
BoostedTrees trees_of(const Parameters& parameters, std::size_t features) {
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
    trees.feature.push_back(value >= 0.0 && value < static_cast<double>(features)
                                ? static_cast<std::uint8_t>(value)
                                : static_cast<std::uint8_t>(features));
  }
  for (const double value : parameter(parameters, "threshold", count * trees.nodes())) {
    trees.threshold.push_back(static_cast<float>(value));
  }
  for (const double value : parameter(parameters, "leaf", count * trees.leaves())) {
    trees.leaf.push_back(static_cast<float>(value));
  }
  return trees;
}

template <typename Inputs>
Model fit_boosted_trees(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs.together(), [&](std::span<const LabelledRun> labelled) {
    BoostingConfig config;
    config.trees = static_cast<std::size_t>(entry.chosen("trees"));
    config.depth = static_cast<std::size_t>(entry.chosen("depth"));
    config.legs = legs_of(runs);
    config.servo_load = runs.servo_load;
    Parameters parameters = parameters_of(fit_trees(
        boosting_rows<Inputs>(labelled, config, runs.before_density), config, runs.before_density));
    parameters["servo_load"] = {config.servo_load ? 1.0 : 0.0};
    return parameters;
  });
}

template <typename Inputs>
std::unique_ptr<ContactEstimator> make_boosted_trees(const EstimatorEntry& entry,
                                                     const EstimatorSetup& setup) {
  const Parameters parameters = touchdown::parameters_of(setup.model->arrays);
  return std::make_unique<BoostedTreesEstimator<Inputs>>(
      trees_of(parameters, Inputs::count),
      typename BoostedTreesEstimator<Inputs>::Config{
          .inputs = {.sample_rate = setup.sample_rate,
                     .legs = setup.legs.value_or(LegGeometry{}),
                     .servo_load = parameter(parameters, "servo_load") != 0.0},
          .point = {.leave_below = entry.chosen("leave_below"),
                    .return_above = entry.chosen("return_above")}});
}

template <typename Inputs>
EstimatorEntry boosted_entry(const char* name, const char* title, const char* summary,
                             const RobotKnowledge& knows) {
  return {.name = name,
          .title = title,
          .summary = summary,
          .reason = "reference: what its inputs contain",
          .sensors = all_sensors,
          .knows = knows,
          .is_upper_bound = true,
          .hyperparameters = {fitted_with(whole_between("trees", BoostingConfig{}.trees, 40, 240)),
                              fitted_with(whole_between("depth", BoostingConfig{}.depth, 3, 8)),
                              between("leave_below", network_point.leave_below, 0.1, 0.95),
                              between("return_above", network_point.return_above, 0.8, 0.995)},
          .fitting = {.fit = fit_boosted_trees<Inputs>, .learns_from_segments = true},
          .making = {.by_step = make_boosted_trees<Inputs>}};
}

}  // namespace

std::vector<EstimatorEntry> boosted_entries() {
  return {
      boosted_entry<ChannelInputs>(
          "boosted_channels", "Boosted trees, own channels",
          "Classifies the channels of the evidence curves by boosted trees, as their upper bound",
          {.geometry = true, .mass = true, .targets = true}),
      boosted_entry<SignalWindow>(
          "boosted_signals", "Boosted trees, all signals",
          "Classifies 100 ms of all raw signals by boosted trees, as an upper bound",
          {.targets = true})};
}

}  // namespace touchdown::experiments
