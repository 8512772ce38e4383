#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/decision/network.hpp"
#include "estimator/evidence/curves.hpp"
#include "estimator/force/force_kinematics.hpp"
#include "estimator/models/arrays.hpp"

namespace touchdown {

/// A model that consists of a few named arrays of numbers, such as the weights of a small network.
using Parameters = std::map<std::string, std::vector<double>, std::less<>>;

/// The array that only these models have. Its bytes are the estimator's name.
inline constexpr std::string_view estimator_array = "estimator";
/// The array with the origin of a model, as the bytes of "key: value" lines.
inline constexpr std::string_view provenance_array = "provenance";

/// All arrays except texts. Errors: `InputError` for numbers that are not finite.
Parameters parameters_of(const ModelArrays& arrays);

/// The inverse, for the model of this estimator.
ModelArrays arrays_of(const Parameters& parameters, const std::string& estimator);

/// Whether an array of this name is a text about the model.
bool is_text_array(std::string_view name);

/// The parameter of this name. Errors: `InputError` unless it has `size` values.
const std::vector<double>& parameter(const Parameters& parameters, std::string_view name,
                                     std::size_t size);

/// The parameter of this name, which has one value. Errors: as above.
double parameter(const Parameters& parameters, std::string_view name);

/// Converts models to parameters and back. Errors: `InputError` for parameters that are missing or
/// of another size.
Parameters parameters_of(const ForceKinematicsModel& model);
Parameters parameters_of(const DecisionModel& model);
/// `curves_<channel>` by time scale, then by knot (nats); `seen_<channel>`, the lower and upper end
/// of each input's range. Those of steps without targets begin with `without_targets_`.
Parameters parameters_of(const EvidenceCurveSets& sets);
ForceKinematicsModel force_kinematics_model_of(const Parameters& parameters);
/// Converts doubles back to the floats that they came from.
DecisionModel decision_model_of(const Parameters& parameters);
/// Likewise.
EvidenceCurveSets evidence_curve_sets_of(const Parameters& parameters);

}  // namespace touchdown
