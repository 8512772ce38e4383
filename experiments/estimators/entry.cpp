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
  const auto found =
      std::find_if(hyperparameters.begin(), hyperparameters.end(),
                   [&](const Hyperparameter& one) { return one.name == hyperparameter; });
  if (found == hyperparameters.end()) {
    throw Error(fmt::format("'{}' has no hyperparameter '{}'", name, hyperparameter));
  }
  return found->value;
}

EstimatorEntry with_hyperparameters(EstimatorEntry entry, const HyperparameterValues& values) {
  if (values.empty()) return entry;
  for (Hyperparameter& hyperparameter : entry.hyperparameters) {
    const auto chosen = values.find(hyperparameter.name);
    if (chosen != values.end()) hyperparameter.value = chosen->second;
  }
  if (entry.apply != nullptr) entry.apply(entry);
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

noise::SensorNoise noise_of(const Sensors& sensors, const noise::SensorNoise& levels) {
  return {.knee_torque = sensors.knee_torque ? levels.knee_torque : 0.0,
          .wheel_torque = sensors.wheel_torque ? levels.wheel_torque : 0.0,
          .acceleration = sensors.acceleration ? levels.acceleration : 0.0,
          .joint_position = sensors.joint_position ? levels.joint_position : 0.0,
          .joint_velocity = sensors.joint_velocity ? levels.joint_velocity : 0.0,
          .hip_torque = sensors.hip_torque ? levels.hip_torque : 0.0};
}

namespace {

/// The members of its configuration that an estimator is made with.
ConfigurationText configuration_of(const EstimatorEntry& entry, const Model& model) {
  if (entry.phase) return text_of(*entry.phase);
  if (entry.config) {
    ConfigurationText text = text_of(*entry.config);
    text["noise.is_followed"] = entry.config->measurement.noise.is_followed ? "true" : "false";
    return text;
  }
  ConfigurationText text;
  const std::optional<ModelMetadata>& metadata = model.metadata;
  // All operating points of evidence curves share a fit: a model of another one gives all settings
  // but the thresholds.
  if (metadata && share_fit(metadata->estimator, entry.name)) text = metadata->configuration;
  if (metadata && metadata->estimator == entry.name) return text;
  for (const Hyperparameter& one : entry.hyperparameters) {
    if (!one.is_fitted_with) text[one.name] = touchdown::text_of(one.value);
  }
  return text;
}

}  // namespace

std::unique_ptr<ContactEstimator> make_of_model(const EstimatorEntry& entry,
                                                const EstimatorSetup& setup) {
  return make_with(*setup.model, {.estimator = entry.name,
                                  .sample_rate = setup.sample_rate,
                                  .configuration = configuration_of(entry, *setup.model),
                                  .configured_rate = setup.sample_rate,
                                  .geometry = setup.legs});
}

EstimatorRunner runner_of(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return entry.whole_run ? EstimatorRunner(entry.whole_run(setup))
                         : EstimatorRunner(entry.make(entry, setup));
}

std::string given_text(const EstimatorEntry& entry, bool servo_load) {
  std::vector<std::string> given;
  if (entry.knows.geometry) given.emplace_back("geometry");
  if (entry.knows.mass) given.emplace_back("mass");
  if (entry.knows.targets && (servo_load || entry.fit == nullptr)) given.emplace_back("targets");
  if (given.empty()) given.emplace_back("signals");
  const char* const model = entry.fits()                ? "; fitted"
                            : !entry.trained_by.empty() ? "; fitted elsewhere"
                                                        : "";
  return fmt::format("{}{}", fmt::join(given, ", "), model);
}

bool share_model(const EstimatorEntry& one, const EstimatorEntry& other) {
  if (one.fit == nullptr || one.fit != other.fit) return false;
  if (one.config) return one.config->measurement == other.config->measurement;
  return !one.phase || one.phase->fit == other.phase->fit;
}

}  // namespace touchdown::experiments
