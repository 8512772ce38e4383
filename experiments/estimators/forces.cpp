#include "estimator/force/force_kinematics_fit.hpp"
#include "estimator/force/load_filter.hpp"
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

std::unique_ptr<ContactEstimator> make_load_filter(const EstimatorEntry& entry,
                                                   const EstimatorSetup& setup) {
  return std::make_unique<LoadFilter>(
      LoadFilterConfig{.sample_rate = setup.sample_rate,
                       .geometry = setup.legs.value_or(LegGeometry{}),
                       .lead = entry.chosen("lead"),
                       .leave_below = entry.chosen("leave_below"),
                       .return_above = entry.chosen("return_above")});
}

EstimatorEntry load_filter_entry() {
  const LoadFilterConfig usual;
  return {.name = "load_filter",
          .title = "Load filter",
          .summary = "Filters each wheel's load, by its leg's equations of motion, with two states",
          .reason = "data: no labels; any robot, by its file alone",
          .sensors = all_sensors,
          .knows = {.geometry = true, .mass = true, .targets = true},
          .hyperparameters = {between("lead", usual.lead, 0.0, 0.02),
                              between("leave_below", usual.leave_below, 0.02, 0.6),
                              between("return_above", usual.return_above, 0.6, 0.995)},
          .making = {.by_step = make_load_filter}};
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
  return {load_filter_entry(), support_force_entry(), force_kinematics_entry()};
}

}  // namespace touchdown::experiments
