#include "estimator/models/parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/error.hpp"
#include "estimator/models/passport.hpp"

namespace touchdown {

namespace {

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

/// Calls `part(name, numbers)` for each part of a network.
template <typename Model, typename Part>
void for_each_part(Model& model, const Part& part) {
  part("first_weight", std::span(model.first_weight));
  part("first_bias", std::span(model.first_bias));
  part("second_weight", std::span(model.second_weight));
  part("second_bias", std::span(model.second_bias));
  part("last_weight", std::span(model.last_weight));
  part("last_bias", std::span(&model.last_bias, 1));
}

}  // namespace

bool is_text_array(std::string_view name) {
  return name == estimator_array || name == provenance_array || name == passport_array;
}

Parameters parameters_of(const ModelArrays& arrays) {
  Parameters parameters;
  for (const auto& [name, array] : arrays) {
    if (is_text_array(name)) continue;
    if (!std::all_of(array.data.begin(), array.data.end(),
                     [](double value) { return std::isfinite(value); })) {
      throw InputError(name + ": expected finite numbers");
    }
    parameters[name] = array.data;
  }
  return parameters;
}

const std::vector<double>& parameter(const Parameters& parameters, std::string_view name,
                                     std::size_t size) {
  const auto found = parameters.find(name);
  if (found == parameters.end()) {
    throw InputError("parameter '" + std::string(name) + "' is missing");
  }
  if (found->second.size() == size) return found->second;
  throw InputError(std::string(name) + ": expected " + std::to_string(size) + " values, found " +
                   std::to_string(found->second.size()));
}

double parameter(const Parameters& parameters, std::string_view name) {
  return parameter(parameters, name, 1)[0];
}

Parameters parameters_of(const LogisticCurve& curve) {
  return {{"slope", {curve.slope}}, {"intercept", {curve.intercept}}};
}

LogisticCurve logistic_curve_of(const Parameters& parameters) {
  return {.slope = parameter(parameters, "slope"), .intercept = parameter(parameters, "intercept")};
}

Parameters parameters_of(const ForceKinematicsModel& model) {
  Parameters parameters;
  for (const auto& [name, of] : state_parameters) {
    parameters[name] = {model.air.*of, model.contact.*of};
  }
  return parameters;
}

ForceKinematicsModel force_kinematics_model_of(const Parameters& parameters) {
  ForceKinematicsModel model;
  for (const auto& [name, of] : state_parameters) {
    const std::vector<double>& values = parameter(parameters, name, 2);
    model.air.*of = values[0];
    model.contact.*of = values[1];
  }
  return model;
}

Parameters parameters_of(const DecisionModel& model) {
  Parameters parameters;
  for_each_part(model, [&](const char* name, auto numbers) {
    parameters[name].assign(numbers.begin(), numbers.end());
  });
  return parameters;
}

DecisionModel decision_model_of(const Parameters& parameters) {
  DecisionModel model;
  for_each_part(model, [&](const char* name, auto numbers) {
    const std::vector<double>& values = parameter(parameters, name, numbers.size());
    std::transform(values.begin(), values.end(), numbers.begin(),
                   [](double value) { return static_cast<float>(value); });
  });
  return model;
}

}  // namespace touchdown
