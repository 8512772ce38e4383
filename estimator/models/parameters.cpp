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

/// Calls `part(name, first, count)` for each group of inputs with one parameter for their curves:
/// the time scales of a channel, or a noise level.
template <typename Part>
void for_each_channel(const EvidenceModel& model, const Part& part) {
  std::size_t first = 0;
  const auto with_scales = [&](const auto& channels) {
    for (const EvidenceChannel& channel : channels) {
      part(channel.name, first, decision_scales);
      first += decision_scales;
    }
  };
  with_scales(evidence_channels);
  for (const char* const name : evidence_noise_names) part(name, first++, std::size_t{1});
  if (!model.servo_curve.empty()) with_scales(servo_load_channels);
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
  for_each_channel(model, [&](const char* name, std::size_t first, std::size_t count) {
    std::vector<double>& curves = parameters[curves_name(set, name)];
    std::vector<double>& seen = parameters[seen_name(set, name)];
    for (std::size_t i = first; i < first + count; ++i) {
      curves.insert(curves.end(), curve_of(model, i).begin(), curve_of(model, i).end());
      seen.insert(seen.end(), seen_by(model, i).begin(), seen_by(model, i).end());
    }
  });
}

EvidenceModel curves_of(const Parameters& parameters, const std::string& set) {
  EvidenceModel model;
  model.bias = static_cast<float>(parameter(parameters, bias_name(set)));
  if (parameters.contains(curves_name(set, servo_load_channels[0].name))) {
    model.servo_curve.resize(std::tuple_size_v<ServoLoadInputs>);
    model.servo_seen.resize(model.servo_curve.size());
  }
  for_each_channel(model, [&](const char* name, std::size_t first, std::size_t count) {
    const std::vector<double>& curves =
        parameter(parameters, curves_name(set, name), count * evidence_knots);
    const std::vector<double>& seen = parameter(parameters, seen_name(set, name), 2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      take(curves.data() + i * evidence_knots, curve_of(model, first + i));
      take(seen.data() + 2 * i, seen_by(model, first + i));
    }
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
  const auto put = [&](const char* name, std::span<const float> numbers) {
    if (!numbers.empty()) parameters[name].assign(numbers.begin(), numbers.end());
  };
  for_each_part(put, model);
  return parameters;
}

DecisionModel decision_model_of(const Parameters& parameters) {
  check_feature_set(parameters);
  DecisionModel model;
  if (parameters.contains("servo_weight")) model.servo_weight.resize(servo_weights);
  const auto read = [&](const char* name, std::span<float> numbers) {
    if (!numbers.empty()) take(parameter(parameters, name, numbers.size()).data(), numbers);
  };
  for_each_part(read, model);
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
