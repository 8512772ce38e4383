#include "experiments/estimators/entry.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "estimator/models/configuration.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/numerics/number_text.hpp"
#include "experiments/signals/reserved_seeds.hpp"

namespace touchdown::experiments {

Hyperparameter between(std::string name, double value, double lowest, double highest) {
  return {std::move(name), value, lowest, highest, Hyperparameter::Scale::even};
}

Hyperparameter around(std::string name, double value, double factor) {
  return {std::move(name), value, value / factor, value * factor, Hyperparameter::Scale::by_ratio};
}

Hyperparameter whole_between(std::string name, double value, double lowest, double highest) {
  return {std::move(name), value, lowest, highest, Hyperparameter::Scale::whole};
}

Hyperparameter fitted_with(Hyperparameter hyperparameter) {
  hyperparameter.is_fitted_with = true;
  return hyperparameter;
}

double EstimatorEntry::chosen(std::string_view hyperparameter) const {
  const auto found = std::ranges::find(hyperparameters, hyperparameter, &Hyperparameter::name);
  if (found == hyperparameters.end()) {
    throw Error(fmt::format("'{}' has no hyperparameter '{}'", name, hyperparameter));
  }
  return found->value;
}

Model EstimatorEntry::fit(FitRuns runs, double skip) const {
  for (const RunSignals* run : runs) check_may_be_fitted(run->info);
  return fitting.fit(*this, runs, skip);
}

std::unique_ptr<ContactEstimator> EstimatorEntry::make(const EstimatorSetup& setup) const {
  if (making.by_step != nullptr) return making.by_step(*this, setup);
  throw InputError(fmt::format(
      "'{}' {}", name,
      making.whole_run ? "processes whole runs, and this use needs one step at a time"
                       : "is written in Python, and `python3 -m touchdown run` runs it"));
}

EstimatorRunner EstimatorEntry::runner(const EstimatorSetup& setup) const {
  return making.whole_run ? EstimatorRunner(making.whole_run(setup)) : EstimatorRunner(make(setup));
}

EstimatorEntry with_hyperparameters(EstimatorEntry entry, const HyperparameterValues& values) {
  FitMethod& fitting = entry.fitting;
  for (Hyperparameter& hyperparameter : entry.hyperparameters) {
    const auto& name = hyperparameter.name;
    const auto chosen = values.find(name);
    if (chosen == values.end()) continue;
    const double value = hyperparameter.value = chosen->second;
    const auto member = entry.configuration.find(name);
    if (member != entry.configuration.end()) member->second = text_of(value);
    if (name == "bandwidth_floor") fitting.torques->fit.bandwidth_floor = {value, value};
  }
  return entry;
}

void check_names(const HyperparameterValues& values, const EstimatorEntry& entry) {
  std::vector<std::string> known;
  for (const Hyperparameter& one : entry.hyperparameters) known.push_back(one.name);
  for (const auto& [name, value] : values) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(known.empty()
                         ? fmt::format("'{}' has no hyperparameters", entry.name)
                         : fmt::format("'{}' has no hyperparameter '{}'{}: expected one of {}",
                                       entry.name, name, did_you_mean(name, known),
                                       fmt::join(known, ", ")));
  }
}

void check_values(const HyperparameterValues& values, const EstimatorEntry& entry) {
  ConfigurationText configuration;
  for (const Hyperparameter& one : entry.hyperparameters) {
    const auto given = values.find(one.name);
    if (given != values.end() && !one.is_fitted_with) {
      configuration[one.name] = text_of(given->second);
    }
  }
  check_configuration(entry.name, configuration);
}

noise::SensorNoise noise_of(const Sensors& sensors, const noise::SensorNoise& levels) {
  return {.knee_torque = sensors.knee_torque ? levels.knee_torque : 0.0,
          .wheel_torque = sensors.wheel_torque ? levels.wheel_torque : 0.0,
          .acceleration = sensors.acceleration ? levels.acceleration : 0.0,
          .joint_position = sensors.joint_position ? levels.joint_position : 0.0,
          .joint_velocity = sensors.joint_velocity ? levels.joint_velocity : 0.0,
          .hip_torque = sensors.hip_torque ? levels.hip_torque : 0.0};
}

std::unique_ptr<ContactEstimator> make_of_model(const EstimatorEntry& entry,
                                                const EstimatorSetup& setup) {
  static const Model none;  // the load filter needs only legs
  const Model& model = setup.model == nullptr ? none : *setup.model;
  ConfigurationText configuration = entry.configuration;
  const std::optional<ModelMetadata>& metadata = model.metadata;
  if (metadata && share_fit(metadata->estimator, entry.name)) {
    configuration.insert(metadata->configuration.begin(), metadata->configuration.end());
  }
  if (!metadata || metadata->estimator != entry.name) {
    for (const Hyperparameter& one : entry.hyperparameters) {
      if (!one.is_fitted_with) configuration[one.name] = text_of(one.value);
    }
  }
  if (setup.legs && entry.knows.geometry) put_into(configuration, *setup.legs);
  return make_with(model, {.estimator = entry.name,
                           .sample_rate = setup.sample_rate,
                           .configuration = std::move(configuration),
                           .configured_rate = setup.configured_rate > 0.0 ? setup.configured_rate
                                                                          : setup.sample_rate});
}

std::string given_text(const EstimatorEntry& entry) {
  std::vector<std::string> given;
  if (entry.knows.geometry) given.emplace_back("geometry");
  if (entry.knows.mass) given.emplace_back("mass");
  if (entry.knows.targets) given.emplace_back("targets");
  if (given.empty()) given.emplace_back("signals");
  const char* const model = entry.fits()                        ? "; fitted"
                            : !entry.fitting.trained_by.empty() ? "; fitted elsewhere"
                                                                : "";
  return fmt::format("{}{}", fmt::join(given, ", "), model);
}

bool share_model(const EstimatorEntry& one, const EstimatorEntry& other) {
  return one.fits() && one.fitting.fit == other.fitting.fit &&
         one.fitting.torques == other.fitting.torques;
}

}  // namespace touchdown::experiments
