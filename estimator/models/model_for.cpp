#include "estimator/models/model_for.hpp"

#include <string>

#include "core/error.hpp"
#include "estimator/models/configuration.hpp"
#include "estimator/models/make_estimator.hpp"

namespace touchdown {

namespace {

/// Errors: `InputError` for an estimator whose configuration, usually as in `usual`, has no legs.
void put_legs(const LegGeometry& legs, const ConfigurationText& usual, ModelPassport& passport) {
  bool uses_legs = false;
  for (const auto& [key, value] : text_of(legs)) {
    if (!usual.contains(key)) continue;
    passport.configuration[key] = value;
    uses_legs = true;
  }
  if (uses_legs) return;
  throw InputError("'" + passport.estimator +
                   "' uses no kinematics: legs tell it nothing, it has to be fitted to the robot");
}

}  // namespace

ModelArrays model_for(ModelArrays arrays, const ModelUse& use) {
  ModelUse any_robot = use;
  if (use.geometry) any_robot.robot.clear();
  ModelPassport passport = passport_for(arrays, any_robot);
  any_robot.estimator = passport.estimator;
  make_estimator(arrays, any_robot);  // says what is wrong with it now rather than on the robot
  const ConfigurationText usual = default_configuration(passport.estimator, passport.sample_rate);
  if (passport.configuration.empty()) passport.configuration = usual;
  if (use.geometry) put_legs(*use.geometry, usual, passport);
  for (const auto& [key, value] : use.configuration) passport.configuration[key] = value;
  if (use.geometry || passport.robot.empty()) passport.robot = use.robot;
  add_passport(arrays, passport);
  return arrays;
}

}  // namespace touchdown
