#pragma once

#include <memory>

#include "estimator/neural/network.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::test {

/// A network with random weights, large enough that its gates leave their linear range.
inline NeuralNetwork random_network(int hidden = 128, int first = 256, int second = 128,
                                    std::uint32_t seed = 1) {
  Normal normal(seed);
  const auto vector = [&](Eigen::Index size, double scale) {
    Eigen::VectorXf v(size);
    for (float& x : v) x = static_cast<float>(scale * normal());
    return v;
  };
  const auto layer = [&](Eigen::Index outputs, Eigen::Index inputs) {
    DenseLayer dense;
    const double scale = 1.5 / std::sqrt(static_cast<double>(inputs));
    dense.weight.resize(outputs, inputs);
    for (float& x : dense.weight.reshaped()) x = static_cast<float>(scale * normal());
    dense.bias = vector(outputs, 0.3);
    return dense;
  };
  NeuralNetwork network;
  network.input_mean = vector(neural_input_count, 1.0);
  network.input_scale = vector(neural_input_count, 0.2).array().abs() + 0.2F;
  network.gru_input = layer(3 * hidden, neural_input_count);
  network.gru_hidden = layer(3 * hidden, hidden);
  network.first = layer(first, hidden);
  network.second = layer(second, first);
  network.heads = layer(neural_output_count, second);
  return network;
}

inline std::shared_ptr<const NeuralNetwork> shared(NeuralNetwork network) {
  return std::make_shared<const NeuralNetwork>(std::move(network));
}

}  // namespace touchdown::test
