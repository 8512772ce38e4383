#include "training/torch_network.hpp"

#include <torch/nn/functional/activation.h>

namespace touchdown::training {

namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

torch::Tensor to_tensor(const Eigen::MatrixXf& matrix) {
  RowMajor rows = matrix;
  return torch::from_blob(rows.data(), {matrix.rows(), matrix.cols()}).clone();
}

Eigen::MatrixXf to_matrix(const torch::Tensor& tensor) {
  const torch::Tensor rows = tensor.detach().contiguous();
  return Eigen::Map<const RowMajor>(rows.data_ptr<float>(), rows.size(0), rows.size(1));
}

Eigen::VectorXf to_vector(const torch::Tensor& tensor) {
  const torch::Tensor numbers = tensor.detach().contiguous();
  return Eigen::Map<const Eigen::VectorXf>(numbers.data_ptr<float>(), numbers.size(0));
}

void set(const torch::Tensor& weight, const torch::Tensor& bias, const DenseLayer& layer) {
  const torch::NoGradGuard no_grad;
  weight.copy_(to_tensor(layer.weight));
  bias.copy_(to_tensor(layer.bias).flatten());
}

torch::nn::Linear linear(const DenseLayer& layer) {
  torch::nn::Linear module(layer.weight.cols(), layer.weight.rows());
  set(module->weight, module->bias, layer);
  return module;
}

DenseLayer layer(const torch::Tensor& weight, const torch::Tensor& bias) {
  return {to_matrix(weight), to_vector(bias)};
}

}  // namespace

TorchNetwork::TorchNetwork(const NeuralNetwork& network)
    : period_(network.period),
      input_mean_(register_buffer("input_mean", to_tensor(network.input_mean).flatten())),
      input_scale_(register_buffer("input_scale", to_tensor(network.input_scale).flatten())),
      gru_(register_module(
          "gru", torch::nn::GRU(torch::nn::GRUOptions(neural_input_count, network.hidden())))),
      first_(register_module("first", linear(network.first))),
      second_(register_module("second", linear(network.second))),
      heads_(register_module("heads", linear(network.heads))) {
  const auto weights = gru_->named_parameters();
  set(weights["weight_ih_l0"], weights["bias_ih_l0"], network.gru_input);
  set(weights["weight_hh_l0"], weights["bias_hh_l0"], network.gru_hidden);
}

NeuralNetwork TorchNetwork::numbers() const {
  const auto weights = gru_->named_parameters();
  NeuralNetwork network;
  network.period = period_;
  network.input_mean = to_vector(input_mean_);
  network.input_scale = to_vector(input_scale_);
  network.gru_input = layer(weights["weight_ih_l0"], weights["bias_ih_l0"]);
  network.gru_hidden = layer(weights["weight_hh_l0"], weights["bias_hh_l0"]);
  network.first = layer(first_->weight, first_->bias);
  network.second = layer(second_->weight, second_->bias);
  network.heads = layer(heads_->weight, heads_->bias);
  return network;
}

std::pair<torch::Tensor, torch::Tensor> TorchNetwork::forward(const torch::Tensor& inputs,
                                                              const torch::Tensor& hidden) {
  auto [features, next_hidden] = gru_->forward((inputs - input_mean_) * input_scale_, hidden);
  features = torch::relu(first_->forward(features));
  features = torch::relu(second_->forward(features));
  return {heads_->forward(features), next_hidden};
}

void TorchNetwork::share_parameters_of(const TorchNetwork& other) {
  const auto mine = parameters();
  const auto theirs = other.parameters();
  for (std::size_t i = 0; i < mine.size(); ++i) {
    mine[i].set_data(theirs[i].detach());
  }
}

}  // namespace touchdown::training
