#include "experiments/estimators/forces.hpp"

#include "estimator/force/force_kinematics_fit.hpp"
#include "estimator/force/load_logistic_fit.hpp"
#include "estimator/force/support_force.hpp"
#include "experiments/estimators/parameter_fitting.hpp"

namespace touchdown::experiments {

namespace {

using Made = std::unique_ptr<ContactEstimator>;
using recordings::parameter;
using recordings::Parameters;

/// What a leg's load is computed from.
constexpr Sensors of_a_load = {
    .hip_torque = true, .knee_torque = true, .acceleration = true, .joint_position = true};

FittedModel fit_logistic_curve(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs, [](std::span<const LabelledRun> labelled) {
    const LogisticCurve curve = fit_load_logistic(labelled);
    return Parameters{{"slope", {curve.slope}}, {"intercept", {curve.intercept}}};
  });
}

Made make_load_logistic(const EstimatorEntry& /*entry*/, const EstimatorSetup& setup) {
  const Parameters& fitted = setup.model->parameters->parameters;
  return std::make_unique<LoadLogistic>(LogisticCurve{.slope = parameter(fitted, "slope"),
                                                      .intercept = parameter(fitted, "intercept")},
                                        LoadLogisticConfig{.sample_rate = setup.sample_rate});
}

/// What of a wheel's state each parameter holds: without contact, in contact.
struct StateParameter {
  const char* name;
  double WheelState::*of;
};
constexpr std::array<StateParameter, 4> state_parameters = {
    {{"force_mean", &WheelState::force_mean},
     {"force_deviation", &WheelState::force_deviation},
     {"axle_deviation", &WheelState::axle_deviation},
     {"leaving_rate", &WheelState::leaving_rate}}};

FittedModel fit_wheel_states(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs, [](std::span<const LabelledRun> labelled) {
    const ForceKinematicsModel model = fit_force_kinematics(labelled);
    Parameters parameters;
    for (const auto& [name, of] : state_parameters) {
      parameters[name] = {model.air.*of, model.contact.*of};
    }
    return parameters;
  });
}

Made make_force_kinematics(const EstimatorEntry& /*entry*/, const EstimatorSetup& setup) {
  ForceKinematicsModel model;
  for (const auto& [name, of] : state_parameters) {
    const std::vector<double>& values = parameter(setup.model->parameters->parameters, name, 2);
    model.air.*of = values[0];
    model.contact.*of = values[1];
  }
  return std::make_unique<ForceKinematics>(model,
                                           ForceKinematicsConfig{.sample_rate = setup.sample_rate});
}

}  // namespace

EstimatorEntry support_force_entry() {
  return {
      .name = "support_force",
      .title = "Support force",
      .summary = "a threshold on each wheel's load, from its leg's torques and geometry",
      .sensors = of_a_load,
      .make = [](const EstimatorEntry& /*entry*/, const EstimatorSetup& setup) -> Made {
        return std::make_unique<SupportForce>(SupportForceConfig{.sample_rate = setup.sample_rate});
      }};
}

EstimatorEntry load_logistic_entry() {
  return {.name = "load_logistic",
          .title = "Load, logistic",
          .summary = "each wheel's load through a logistic curve (Camurri et al. 2017, on wheels)",
          .sensors = of_a_load,
          .fit = fit_logistic_curve,
          .make = make_load_logistic};
}

EstimatorEntry force_kinematics_entry() {
  Sensors sensors = of_a_load;
  sensors.joint_velocity = true;
  return {
      .name = "force_kinematics",
      .title = "Force and kinematics",
      .summary =
          "a hidden Markov model of each wheel's load and its axle's motion (Hwangbo et al. 2016, "
          "on wheels)",
      .sensors = sensors,
      .fit = fit_wheel_states,
      .make = make_force_kinematics};
}

}  // namespace touchdown::experiments
