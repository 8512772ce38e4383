#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>

#include "estimator/neural/network.hpp"

namespace touchdown::training {

/// The neural measurement network in libtorch: the parameters of `NeuralNetwork`, with gradients.
class TorchNetwork : public torch::nn::Module {
 public:
  explicit TorchNetwork(const NeuralNetwork& network);

  /// The parameters, standardisation included.
  NeuralNetwork numbers() const;

  /// Maps raw inputs (steps × batch × neural_input_count) and hidden state (1 × batch × hidden) to
  /// outputs (steps × batch × neural_output_count) and the next hidden state.
  std::pair<torch::Tensor, torch::Tensor> forward(const torch::Tensor& inputs,
                                                  const torch::Tensor& hidden);

  /// The initial hidden state (1 × batch × hidden).
  torch::Tensor initial_state(std::int64_t batch) const {
    return torch::zeros({1, batch, gru_->options.hidden_size()});
  }

  /// Shares the memory of the parameters of `other`, with separate gradients.
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
