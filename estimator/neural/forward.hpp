#pragma once

#include <memory>

#include <Eigen/Core>

#include "estimator/neural/network.hpp"

namespace touchdown {

/// Runs a neural network through time and holds its recurrent state. `step` neither throws nor
/// allocates.
class NeuralForward {
 public:
  using Column = Eigen::VectorXf;

  /// Errors: `InputError` for no network or one that `check` refuses.
  explicit NeuralForward(std::shared_ptr<const NeuralNetwork> network);

  /// Sets the hidden state to zero, as at the beginning of a training episode.
  void reset() noexcept { hidden_.setZero(); }

  /// One step: raw inputs (neural_input_count) to outputs (neural_output_count).
  const Column& step(const Column& inputs) noexcept;

  [[nodiscard]] const NeuralNetwork& network() const noexcept { return *network_; }
  [[nodiscard]] std::shared_ptr<const NeuralNetwork> shared_network() const noexcept {
    return network_;
  }

 private:
  std::shared_ptr<const NeuralNetwork> network_;
  Column standardised_;
  Column hidden_;
  Column from_input_;
  Column from_hidden_;
  Column first_;
  Column second_;
  Column outputs_;
};

}  // namespace touchdown
