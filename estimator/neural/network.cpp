#include "estimator/neural/network.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"

namespace touchdown {
namespace {

std::string shape(Eigen::Index rows, Eigen::Index columns) {
  return std::to_string(rows) + " × " + std::to_string(columns);
}

void check_vector(const Eigen::VectorXf& vector, const std::string& name, Eigen::Index size) {
  if (vector.size() != size) {
    throw InputError(name + ": expected " + std::to_string(size) + " numbers, found " +
                     std::to_string(vector.size()));
  }
  if (!vector.allFinite()) throw InputError(name + ": expected finite numbers");
}

void check_layer(const DenseLayer& layer, const std::string& name, Eigen::Index outputs,
                 Eigen::Index inputs) {
  const Eigen::MatrixXf& w = layer.weight;
  if (w.rows() != outputs || w.cols() != inputs) {
    throw InputError(name + "_weight: expected shape " + shape(outputs, inputs) + ", found " +
                     shape(w.rows(), w.cols()));
  }
  if (!w.allFinite()) throw InputError(name + "_weight: expected finite numbers");
  check_vector(layer.bias, name + "_bias", outputs);
}

}  // namespace

void check(const NeuralNetwork& network) {
  const Eigen::Index hidden = network.hidden();
  if (hidden == 0) throw InputError("gru_hidden_weight: is empty");
  if (!(std::isfinite(network.period) && network.period > 0.0)) {
    throw InputError("period: expected a positive number (s)");
  }
  check_vector(network.input_mean, "input_mean", neural_input_count);
  check_vector(network.input_scale, "input_scale", neural_input_count);
  check_layer(network.gru_input, "gru_input", 3 * hidden, neural_input_count);
  check_layer(network.gru_hidden, "gru_hidden", 3 * hidden, hidden);
  check_layer(network.first, "first", network.first.weight.rows(), hidden);
  check_layer(network.second, "second", network.second.weight.rows(), network.first.weight.rows());
  check_layer(network.heads, "heads", neural_output_count, network.second.weight.rows());
}

}  // namespace touchdown
