#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimator/bayes/measurement_model.hpp"
#include "estimator/models/arrays.hpp"
#include "estimator/models/metadata.hpp"
#include "estimator/neural/network.hpp"

namespace touchdown {

/// A fitted model: numbers that a fit found, and what the fit was made for. Fits return it; files
/// and compiled-in headers hold it as `arrays_of` gives it. Copies, and the estimators that are
/// made of it, share the large numbers of `grid`.
struct Model {
  /// As in its file, without the metadata. Those of a new `grid` are not here.
  ModelArrays arrays = {};
  std::optional<MeasurementModel> grid = {};  ///< densities of torques
  /// Older files, and files from elsewhere, have none.
  std::optional<ModelMetadata> metadata = {};
};

/// Whether there is a fit in it.
bool has_numbers(const Model& model);

/// The model of a file's arrays. Errors: `InputError` for arrays that are no model, for the model
/// of an estimator that this version does not have, and those of `metadata_of`.
Model model_of(ModelArrays arrays);

/// The inverse, with the metadata and their fingerprint, if there are any.
ModelArrays arrays_of(const Model& model);

/// The estimator that the model was fitted for, as its metadata or its arrays name it; empty for a
/// grid without metadata.
std::string estimator_of(const Model& model);

/// Reads a measurement model in the layout of the paper's authors: the axes `wheel_torque` and
/// `knee_torque` (N·m), `contact_likelihood` and `no_contact_likelihood` with one row per wheel
/// torque. Errors: `InputError` for missing arrays (lists them all), wrong shapes, irregular axes,
/// and values that are not likelihoods.
MeasurementModel measurement_model_of(const ModelArrays& arrays);

/// The inverse, `P_contact` included: contact over the sum of both, ½ where both are zero.
ModelArrays arrays_of(const MeasurementModel& model);

/// Reads a neural measurement network: `period`, `input_mean`, `input_scale` and, for `gru_input`,
/// `gru_hidden`, `first`, `second` and `heads`, `<layer>_weight` and `<layer>_bias`. Errors:
/// `InputError` for missing arrays (lists them all), shapes that do not fit, and numbers that are
/// not finite.
NeuralNetwork neural_network_of(const ModelArrays& arrays);

/// The inverse. It keeps every bit of single precision.
ModelArrays arrays_of(const NeuralNetwork& network);

}  // namespace touchdown
