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
      values_{Column(neural_input_count),
              Column(network_->hidden()),
              Column(3 * network_->hidden()),
              Column(3 * network_->hidden()),
              Column(network_->first.weight.rows()),
              Column(network_->second.weight.rows()),
              Column(neural_output_count)} {
  reset();
}

const NeuralForward::Column& NeuralForward::step(const Column& inputs) noexcept {
  values_.standardised = inputs - network_->input_mean;
  values_.standardised.array() *= network_->input_scale.array();
  // Starts from the bias and adds the product, so that no temporary is made.
  neural_step(*network_, values_, [](const DenseLayer& layer, const Column& x, Column& y) {
    y = layer.bias;
    y.noalias() += layer.weight * x;
  });
  return values_.outputs;
}

}  // namespace touchdown
