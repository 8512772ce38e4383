#pragma once

#include <string>
#include <vector>

#include "estimator/models/arrays.hpp"
#include "estimator/neural/network.hpp"

namespace touchdown {

/// The arrays of a neural measurement network: `period`, `input_mean`, `input_scale` and, for
/// `gru_input`, `gru_hidden`, `first`, `second` and `heads`, `<layer>_weight` and `<layer>_bias`.
std::vector<std::string> neural_array_names();

/// Errors: `InputError` for missing arrays (lists them all), shapes that do not fit, and numbers
/// that are not finite.
NeuralNetwork neural_network_of(const ModelArrays& arrays);

/// The inverse. It keeps every bit of single precision.
ModelArrays arrays_of(const NeuralNetwork& network);

}  // namespace touchdown
