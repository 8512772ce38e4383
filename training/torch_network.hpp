#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>

#include "estimator/neural/network.hpp"

namespace touchdown::training {

/// The neural measurement network as libtorch trains it: the same numbers as `NeuralNetwork`, with
/// gradients.
class TorchNetwork : public torch::nn::Module {
 public:
  explicit TorchNetwork(const NeuralNetwork& network);

  /// Its numbers, standardisation included.
  NeuralNetwork numbers() const;

  /// From raw inputs (steps × lanes × neural_input_count) and hidden state (1 × lanes × hidden) to
  /// outputs (steps × lanes × neural_output_count) and the next hidden state.
  std::pair<torch::Tensor, torch::Tensor> forward(const torch::Tensor& inputs,
                                                  const torch::Tensor& hidden);

  torch::Tensor no_memory(std::int64_t lanes) const {
    return torch::zeros({1, lanes, gru_->options.hidden_size()});
  }

  /// Makes this network's parameters the same memory as those of `other`, with gradients of its
  /// own.
  void share_parameters_of(const TorchNetwork& other);

 private:
  double period_;
  torch::Tensor input_mean_;
  torch::Tensor input_scale_;
  torch::nn::GRU gru_;
  torch::nn::Linear first_;
  torch::nn::Linear second_;
  torch::nn::Linear heads_;
};

}  // namespace touchdown::training
