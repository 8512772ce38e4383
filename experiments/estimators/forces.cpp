#include "experiments/estimators/forces.hpp"

#include "estimator/force/force_kinematics_fit.hpp"
#include "estimator/force/load_logistic_fit.hpp"
#include "estimator/force/support_force.hpp"
#include "experiments/estimators/parameter_fitting.hpp"

namespace touchdown::experiments {

namespace {

using Made = std::unique_ptr<ContactEstimator>;

/// What a leg's load is computed from.
constexpr Sensors of_a_load = {
    .hip_torque = true, .knee_torque = true, .acceleration = true, .joint_position = true};

FittedModel fit_logistic_curve(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs, [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_load_logistic(
        labelled, {.geometry = legs_of(runs), .low_pass = entry.chosen("low_pass")}));
  });
}

Made make_load_logistic(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return std::make_unique<LoadLogistic>(
      logistic_curve_of(setup.model->parameters->parameters),
      configured(LoadLogisticConfig{.sample_rate = setup.sample_rate}, entry, setup));
}

FittedModel fit_wheel_states(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs, [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_force_kinematics(labelled, {.geometry = legs_of(runs),
                                                         .low_pass = entry.chosen("low_pass"),
                                                         .leak = entry.chosen("leak")}));
  });
}

Made make_force_kinematics(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return std::make_unique<ForceKinematics>(
      force_kinematics_model_of(setup.model->parameters->parameters),
      configured(ForceKinematicsConfig{.sample_rate = setup.sample_rate}, entry, setup));
}

}  // namespace

EstimatorEntry support_force_entry() {
  return {.name = "support_force",
          .title = "Support force",
          .summary = "a threshold on each wheel's load, from its leg's torques and geometry",
          .sensors = of_a_load,
          .hyperparameters = {around("contact", SupportForceConfig{}.contact, 4.0),
                      between("release_share", 0.5, 0.2, 0.95),
                      around("low_pass", SupportForceConfig{}.low_pass, 5.0)},
          .make = [](const EstimatorEntry& entry, const EstimatorSetup& setup) -> Made {
            const double contact = entry.chosen("contact");
            return std::make_unique<SupportForce>(
                SupportForceConfig{.sample_rate = setup.sample_rate,
                                   .geometry = setup.legs.value_or(LegGeometry{}),
                                   .low_pass = entry.chosen("low_pass"),
                                   .contact = contact,
                                   .release = contact * entry.chosen("release_share")});
          }};
}

EstimatorEntry load_logistic_entry() {
  return {.name = "load_logistic",
          .title = "Load, logistic",
          .summary = "each wheel's load through a logistic curve (Camurri et al. 2017, on wheels)",
          .sensors = of_a_load,
          .fit = fit_logistic_curve,
          .hyperparameters = {between("threshold", LoadLogisticConfig{}.threshold, 0.1, 0.95),
                      fitted_with(around("low_pass", LoadLogisticConfig{}.low_pass, 5.0))},
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
      .hyperparameters = {between("threshold", ForceKinematicsConfig{}.threshold, 0.1, 0.95),
                  fitted_with(around("low_pass", ForceKinematicsConfig{}.low_pass, 5.0)),
                  fitted_with(around("leak", ForceKinematicsConfig{}.leak, 4.0))},
      .make = make_force_kinematics};
}

}  // namespace touchdown::experiments
