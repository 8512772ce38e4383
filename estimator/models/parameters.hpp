#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/decision/network.hpp"
#include "estimator/evidence/curves.hpp"
#include "estimator/evidence/touchdown.hpp"
#include "estimator/force/force_kinematics.hpp"
#include "estimator/force/logistic_regression.hpp"
#include "estimator/models/arrays.hpp"

namespace touchdown {

/// A model that is a few named arrays of numbers: a handful, or the weights of a small network.
using Parameters = std::map<std::string, std::vector<double>, std::less<>>;

/// The array that only these models have: its bytes are the estimator's name.
inline constexpr std::string_view estimator_array = "estimator";
/// Where a model comes from, likewise: "key: value" lines.
inline constexpr std::string_view provenance_array = "provenance";

/// All arrays but those that are texts. Errors: `InputError` for numbers that are not finite.
Parameters parameters_of(const ModelArrays& arrays);

/// Whether an array of this name is a text about the model.
bool is_text_array(std::string_view name);

/// The parameter of this name, which has to have `size` values. Errors: `InputError` otherwise.
const std::vector<double>& parameter(const Parameters& parameters, std::string_view name,
                                     std::size_t size);

/// As above, of one value.
double parameter(const Parameters& parameters, std::string_view name);

/// Estimators' models as parameters, and back. Errors: `InputError` for parameters that are missing
/// or of another size.
Parameters parameters_of(const LogisticCurve& curve);
Parameters parameters_of(const ForceKinematicsModel& model);
Parameters parameters_of(const DecisionModel& model);
/// `curves_<channel>` by time scale, then by knot (nats); what of each was `seen`, a lower and an
/// upper end; `tables` of `pairs`, by row.
Parameters parameters_of(const EvidenceModel& model);
/// Those of its curves and of its network.
Parameters parameters_of(const TouchdownModel& model);
LogisticCurve logistic_curve_of(const Parameters& parameters);
ForceKinematicsModel force_kinematics_model_of(const Parameters& parameters);
/// Doubles that came from floats are floats again.
DecisionModel decision_model_of(const Parameters& parameters);
/// Likewise. Errors: also for tables of other pairs.
EvidenceModel evidence_model_of(const Parameters& parameters);
TouchdownModel touchdown_model_of(const Parameters& parameters);

}  // namespace touchdown
