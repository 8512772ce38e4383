#include "estimator/models/model_for_robot.hpp"

#include <string>

#include "core/error.hpp"
#include "estimator/models/configuration.hpp"
#include "estimator/models/make_estimator.hpp"

namespace touchdown {

namespace {

/// `usual` is the estimator's default configuration. Errors: `InputError` if it has no legs.
void put_legs(const LegGeometry& legs, const ConfigurationText& usual, ModelMetadata& metadata) {
  bool uses_legs = false;
  for (const auto& [key, value] : text_of(legs)) {
    if (!usual.contains(key) && !metadata.configuration.contains(key)) continue;
    metadata.configuration[key] = value;
    uses_legs = true;
  }
  if (uses_legs) return;
  throw InputError("'" + metadata.estimator +
                   "' uses no kinematics, so legs do not adapt it: fit it to the robot");
}

}  // namespace

ModelArrays model_for(ModelArrays arrays, const ModelUse& use) {
  ModelUse any_robot = use;
  if (use.geometry) any_robot.robot.clear();
  ModelMetadata metadata = metadata_for(arrays, any_robot);
  any_robot.estimator = metadata.estimator;
  make_estimator(arrays, any_robot);  // fails here rather than on the robot
  const ConfigurationText usual = default_configuration(metadata.estimator, metadata.sample_rate);
  if (metadata.configuration.empty()) metadata.configuration = usual;
  if (use.geometry) put_legs(*use.geometry, usual, metadata);
  for (const auto& [key, value] : use.configuration) metadata.configuration[key] = value;
  if (use.geometry || metadata.robot.empty()) metadata.robot = use.robot;
  add_metadata(arrays, metadata);
  return arrays;
}

}  // namespace touchdown
