#include "experiments/estimators/entry.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/yaml.hpp"

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

Hyperparameter fitted_with(Hyperparameter choice) {
  choice.is_fitted_with = true;
  return choice;
}

double EstimatorEntry::chosen(std::string_view choice) const {
  const auto found = std::find_if(hyperparameters.begin(), hyperparameters.end(),
                                  [&](const Hyperparameter& one) { return one.name == choice; });
  if (found == hyperparameters.end()) throw Error(fmt::format("'{}' has no choice '{}'", name, choice));
  return found->value;
}

EstimatorEntry with_hyperparameters(EstimatorEntry entry, const HyperparameterValues& hyperparameters) {
  if (hyperparameters.empty()) return entry;
  for (Hyperparameter& choice : entry.hyperparameters) {
    const auto chosen = hyperparameters.find(choice.name);
    if (chosen != hyperparameters.end()) choice.value = chosen->second;
  }
  if (entry.apply != nullptr) entry.apply(entry);
  return entry;
}

void check_names(const HyperparameterValues& hyperparameters, const EstimatorEntry& entry) {
  std::vector<std::string> known;
  for (const Hyperparameter& choice : entry.hyperparameters) known.push_back(choice.name);
  for (const auto& [name, value] : hyperparameters) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(known.empty() ? fmt::format("'{}' has no constants", entry.name)
                                   : fmt::format("'{}' has no constant '{}'{}: expected one of {}",
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

EstimatorRunner runner_of(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return entry.whole_run ? EstimatorRunner(entry.whole_run(setup)) : EstimatorRunner(entry.make(entry, setup));
}

bool share_model(const EstimatorEntry& one, const EstimatorEntry& other) {
  if (one.fit == nullptr || one.fit != other.fit || one.fits() != other.fits()) return false;
  if (one.config) return one.config->measurement == other.config->measurement;
  return !one.phase || one.phase->fit == other.phase->fit;
}

}  // namespace touchdown::experiments
