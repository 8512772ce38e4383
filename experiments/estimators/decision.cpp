#include "experiments/estimators/decision.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "estimator/decision/filter.hpp"
#include "estimator/decision/fit.hpp"
#include "experiments/estimators/parameter_fitting.hpp"

namespace touchdown::experiments {

namespace {

using Made = std::unique_ptr<ContactEstimator>;

/// Calls `part(name, numbers)` for each part of a model.
template <typename Model, typename Part>
void for_each_array(Model& model, const Part& part) {
  part("first_weight", std::span(model.first_weight));
  part("first_bias", std::span(model.first_bias));
  part("second_weight", std::span(model.second_weight));
  part("second_bias", std::span(model.second_bias));
  part("last_weight", std::span(model.last_weight));
  part("last_bias", std::span(&model.last_bias, 1));
}

recordings::Parameters parameters_of(const DecisionModel& model) {
  recordings::Parameters parameters;
  for_each_array(model, [&](const char* name, auto numbers) {
    parameters[name].assign(numbers.begin(), numbers.end());
  });
  return parameters;
}

/// The inverse: doubles that came from floats are floats again.
DecisionModel model_of(const recordings::Parameters& parameters) {
  DecisionModel model;
  for_each_array(model, [&](const char* name, auto numbers) {
    const std::vector<double>& values = recordings::parameter(parameters, name, numbers.size());
    std::transform(values.begin(), values.end(), numbers.begin(),
                   [](double value) { return static_cast<float>(value); });
  });
  return model;
}

/// To whole runs and to pieces alike: what it sees more of, it decides better.
FittedModel fit_network(const EstimatorEntry& entry, const FitRuns& runs) {
  FitRuns all = runs;
  all.whole.insert(all.whole.end(), runs.pieces.begin(), runs.pieces.end());
  return fit_parameters(entry, all, [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_decision_model(labelled, {}, {}, runs.before_density));
  });
}

}  // namespace

EstimatorEntry decision_network_entry() {
  return {.name = "decision_network",
          .title = "Decision network",
          .summary =
              "a small network fitted to decide, from each wheel's load and motion at eight "
              "time scales",
          .sensors = {.hip_torque = true,
                      .knee_torque = true,
                      .wheel_torque = true,
                      .acceleration = true,
                      .joint_position = true,
                      .joint_velocity = true},
          .fit = fit_network,
          .make = [](const EstimatorEntry& /*entry*/, const EstimatorSetup& setup) -> Made {
            return std::make_unique<DecisionNetwork>(
                model_of(setup.model->parameters->parameters),
                DecisionConfig{.sample_rate = setup.sample_rate});
          }};
}

}  // namespace touchdown::experiments
