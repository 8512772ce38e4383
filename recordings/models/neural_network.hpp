#pragma once

#include <filesystem>
#include <string>

#include "estimator/neural/network.hpp"

namespace touchdown::recordings {

/// Writes the weights as NumPy arrays: `period`, `input_mean`, `input_scale` and, for `gru_input`,
/// `gru_hidden`, `first`, `second` and `heads`, `<layer>_weight` and `<layer>_bias`. Their single
/// precision is kept to the bit. Errors: `Error` when the file cannot be written.
void write_neural_network(const NeuralNetwork& network, const std::filesystem::path& path);

/// Reads such a file. Errors: `InputError`, one line that names the file: unreadable or cut off,
/// arrays missing (all of them), shapes that do not fit, numbers that are not finite.
NeuralNetwork read_neural_network(const std::filesystem::path& path);

/// Reads a network that comes with the project, `models/<name>.npz`. Errors: as above; the message
/// for a missing file names the command that makes it.
NeuralNetwork shipped_neural_network(const std::string& name);

}  // namespace touchdown::recordings
