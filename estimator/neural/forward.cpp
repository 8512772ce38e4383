#include "estimator/neural/forward.hpp"

#include <utility>

#include "core/error.hpp"

namespace touchdown {
namespace {

std::shared_ptr<const NeuralNetwork> checked(std::shared_ptr<const NeuralNetwork> network) {
  if (!network) throw InputError("neural estimator: needs a network");
  check(*network);
  return network;
}

}  // namespace

NeuralForward::NeuralForward(std::shared_ptr<const NeuralNetwork> network)
    : network_(checked(std::move(network))),
      standardised_(neural_input_count),
      hidden_(network_->hidden()),
      from_input_(3 * network_->hidden()),
      from_hidden_(3 * network_->hidden()),
      first_(network_->first.weight.rows()),
      second_(network_->second.weight.rows()),
      outputs_(neural_output_count) {
  reset();
}

const NeuralForward::Column& NeuralForward::step(const Column& inputs) noexcept {
  const NeuralNetwork& net = *network_;
  const Eigen::Index n = net.hidden();
  // Starts from the bias and adds the product, so that no temporary is made.
  const auto affine = [](const DenseLayer& layer, const Column& x, Column& y) {
    y = layer.bias;
    y.noalias() += layer.weight * x;
  };
  standardised_ = inputs - net.input_mean;
  standardised_.array() *= net.input_scale.array();

  // Gates as Cho et al. (2014) have them, with the reset gate behind the matrix:
  // h' = (1 − z) ∘ tanh(a_n + r ∘ b_n) + z ∘ h, where r = σ(a_r + b_r) and z = σ(a_z + b_z).
  affine(net.gru_input, standardised_, from_input_);
  affine(net.gru_hidden, hidden_, from_hidden_);
  auto gates = from_input_.topRows(2 * n).array();
  gates = (gates + from_hidden_.topRows(2 * n).array()).logistic();
  const auto reset = from_input_.topRows(n).array();
  const auto update = from_input_.middleRows(n, n).array();
  auto candidate = from_input_.bottomRows(n).array();
  candidate = (candidate + reset * from_hidden_.bottomRows(n).array()).tanh();
  hidden_.array() = candidate + update * (hidden_.array() - candidate);

  affine(net.first, hidden_, first_);
  first_ = first_.cwiseMax(0.0F);
  affine(net.second, first_, second_);
  second_ = second_.cwiseMax(0.0F);
  affine(net.heads, second_, outputs_);
  return outputs_;
}

}  // namespace touchdown
