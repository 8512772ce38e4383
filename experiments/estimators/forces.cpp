#include "estimator/force/force_kinematics_fit.hpp"
#include "estimator/force/support_force.hpp"
#include "estimator/models/parameters.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/fits.hpp"

namespace touchdown::experiments {

namespace {

/// The sensors that a wheel's load is computed from.
constexpr Sensors load_sensors = {
    .hip_torque = true, .knee_torque = true, .acceleration = true, .joint_position = true};

Model fit_wheel_states(const EstimatorEntry& entry, const FitRuns& runs) {
  return fit_parameters(entry, runs, [&](std::span<const LabelledRun> labelled) {
    return parameters_of(fit_force_kinematics(labelled, {.geometry = legs_of(runs),
                                                         .low_pass = entry.chosen("low_pass"),
                                                         .leak = entry.chosen("leak")}));
  });
}

std::unique_ptr<ContactEstimator> make_support_force(const EstimatorEntry& entry,
                                                     const EstimatorSetup& setup) {
  const double contact = entry.chosen("contact");
  return std::make_unique<SupportForce>(
      SupportForceConfig{.sample_rate = setup.sample_rate,
                         .geometry = setup.legs.value_or(LegGeometry{}),
                         .low_pass = entry.chosen("low_pass"),
                         .contact = contact,
                         .release = contact * entry.chosen("release_share")});
}

/// A threshold on each wheel's load, as teams with wheeled legs use it. It needs no fit.
EstimatorEntry support_force_entry() {
  return {.name = "support_force",
          .title = "Support force",
          .summary = "Thresholds each wheel's load, computed from its leg's torques and geometry",
          .reason = "data: no labels at all",
          .sensors = load_sensors,
          .knows = {.geometry = true},
          .hyperparameters = {around("contact", SupportForceConfig{}.contact, 4.0),
                              between("release_share", 0.5, 0.2, 0.95),
                              around("low_pass", SupportForceConfig{}.low_pass, 5.0)},
          .making = {.by_step = make_support_force}};
}

EstimatorEntry force_kinematics_entry() {
  Sensors sensors = load_sensors;
  sensors.joint_velocity = true;
  return {
      .name = "force_kinematics",
      .title = "Force and kinematics",
      .summary =
          "Filters each wheel's load and axle motion by a hidden Markov model (Hwangbo et al. "
          "2016, "
          "on wheels)",
      .reason = "data: 2 s of labels; the usual filter on legged robots",
      .sensors = sensors,
      .knows = {.geometry = true},
      .hyperparameters = {between("threshold", ForceKinematicsConfig{}.threshold, 0.1, 0.95),
                          fitted_with(around("low_pass", ForceKinematicsConfig{}.low_pass, 5.0)),
                          fitted_with(around("leak", ForceKinematicsConfig{}.leak, 4.0))},
      .fitting = {.fit = fit_wheel_states},
      .making = {.by_step = make_of_model}};
}

}  // namespace

std::vector<EstimatorEntry> force_entries() {
  return {support_force_entry(), force_kinematics_entry()};
}

}  // namespace touchdown::experiments
