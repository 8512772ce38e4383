#include "estimator/models/parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/error.hpp"
#include "estimator/evidence/channels.hpp"
#include "estimator/models/metadata.hpp"

namespace touchdown {

namespace {

/// The member of `WheelState` behind each parameter, which holds it without and in contact.
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

/// Calls `part(name, first, count)` for each group of inputs with one parameter for their curves:
/// the time scales of a channel, or a noise level.
template <typename Part>
void for_each_channel(const Part& part) {
  std::size_t first = 0;
  for (const EvidenceChannel& channel : evidence_channels) {
    part(channel.name, first, decision_scales);
    first += decision_scales;
  }
  for (const char* const name : evidence_noise_names) part(name, first++, std::size_t{1});
}

/// Converts values back to the floats that they came from.
void take(const double* from, std::span<float> to) {
  std::transform(from, from + to.size(), to.begin(),
                 [](double value) { return static_cast<float>(value); });
}

/// The parameter with the version of the features that a model was fitted to.
constexpr const char* feature_set = "senses";

void add_feature_set(Parameters& parameters) {
  parameters[feature_set] = {static_cast<double>(feature_set_version)};
}

/// Errors: `InputError` for a model that was fitted to another version of the features.
void check_feature_set(const Parameters& parameters) {
  if (parameters.contains(feature_set) &&
      parameter(parameters, feature_set) == feature_set_version) {
    return;
  }
  throw InputError(
      std::string(feature_set) + ": expected " + std::to_string(feature_set_version) +
      ", this version's features of loads: this model was fitted to another version's, "
      "fit it again");
}

/// Calls `part(name, first)` for the channels of `ServoLoadInputs`.
template <typename Part>
void for_each_servo_channel(const Part& part) {
  std::size_t first = 0;
  for (const EvidenceChannel& channel : servo_load_channels) {
    part(channel.name, first);
    first += decision_scales;
  }
}

constexpr const char* servo_weight_name = "servo_weight";

/// Before the names of the second set's parameters.
constexpr const char* of_muted_steps = "without_targets_";

std::string bias_name(const std::string& set) { return set + "bias"; }
std::string curves_name(const std::string& set, const char* channel) {
  return set + "curves_" + channel;
}
std::string seen_name(const std::string& set, const char* channel) {
  return set + "seen_" + channel;
}

/// Adds the parameters of one set of curves. Their names begin with `set`.
void add_curves(const EvidenceModel& model, const std::string& set, Parameters& parameters) {
  parameters[bias_name(set)] = {model.bias};
  const auto put = [&](const char* name, const EvidenceCurve* curve,
                       const std::array<float, 2>* seen_of, std::size_t count) {
    std::vector<double>& curves = parameters[curves_name(set, name)];
    std::vector<double>& seen = parameters[seen_name(set, name)];
    for (std::size_t i = 0; i < count; ++i) {
      curves.insert(curves.end(), curve[i].begin(), curve[i].end());
      seen.insert(seen.end(), seen_of[i].begin(), seen_of[i].end());
    }
  };
  for_each_channel([&](const char* name, std::size_t first, std::size_t count) {
    put(name, model.curve.data() + first, model.seen.data() + first, count);
  });
  if (model.servo_curve.empty()) return;
  for_each_servo_channel([&](const char* name, std::size_t first) {
    put(name, model.servo_curve.data() + first, model.servo_seen.data() + first, decision_scales);
  });
}

EvidenceModel curves_of(const Parameters& parameters, const std::string& set) {
  EvidenceModel model;
  model.bias = static_cast<float>(parameter(parameters, bias_name(set)));
  const auto read = [&](const char* name, EvidenceCurve* curve, std::array<float, 2>* seen_of,
                        std::size_t count) {
    const std::vector<double>& curves =
        parameter(parameters, curves_name(set, name), count * evidence_knots);
    const std::vector<double>& seen = parameter(parameters, seen_name(set, name), 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      take(curves.data() + i * evidence_knots, curve[i]);
      take(seen.data() + 2 * i, seen_of[i]);
    }
  };
  for_each_channel([&](const char* name, std::size_t first, std::size_t count) {
    read(name, model.curve.data() + first, model.seen.data() + first, count);
  });
  if (!parameters.contains(curves_name(set, servo_load_channels[0].name))) return model;
  model.servo_curve.resize(std::tuple_size_v<ServoLoadInputs>);
  model.servo_seen.resize(model.servo_curve.size());
  for_each_servo_channel([&](const char* name, std::size_t first) {
    read(name, model.servo_curve.data() + first, model.servo_seen.data() + first, decision_scales);
  });
  return model;
}

}  // namespace

bool is_text_array(std::string_view name) {
  return name == estimator_array || name == provenance_array || name == metadata_array;
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

ModelArrays arrays_of(const Parameters& parameters, const std::string& estimator) {
  ModelArrays arrays;
  for (const auto& [name, values] : parameters) arrays[name] = {{values.size()}, values};
  arrays[std::string(estimator_array)] = array_of_text(estimator);
  return arrays;
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
  add_feature_set(parameters);
  for_each_part(model, [&](const char* name, auto numbers) {
    parameters[name].assign(numbers.begin(), numbers.end());
  });
  if (!model.servo_weight.empty()) {
    parameters[servo_weight_name].assign(model.servo_weight.begin(), model.servo_weight.end());
  }
  return parameters;
}

DecisionModel decision_model_of(const Parameters& parameters) {
  check_feature_set(parameters);
  DecisionModel model;
  for_each_part(model, [&](const char* name, auto numbers) {
    const std::vector<double>& values = parameter(parameters, name, numbers.size());
    take(values.data(), numbers);
  });
  if (!parameters.contains(servo_weight_name)) return model;
  model.servo_weight.resize(servo_weights);
  take(parameter(parameters, servo_weight_name, servo_weights).data(), model.servo_weight);
  return model;
}

Parameters parameters_of(const EvidenceCurveSets& sets) {
  Parameters parameters;
  add_feature_set(parameters);
  add_curves(sets.usual, "", parameters);
  if (sets.without_targets) add_curves(*sets.without_targets, of_muted_steps, parameters);
  return parameters;
}

EvidenceCurveSets evidence_curve_sets_of(const Parameters& parameters) {
  check_feature_set(parameters);
  EvidenceCurveSets sets = curves_of(parameters, "");
  if (parameters.contains(bias_name(of_muted_steps))) {
    sets.without_targets = curves_of(parameters, of_muted_steps);
  }
  return sets;
}

}  // namespace touchdown
